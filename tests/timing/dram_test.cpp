// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include "base/errors.h"
#include "memory/fixed_dram.h"
#include "memory/payload_pool.h"
#include "timing/bench.h"

namespace sheaf::test {
namespace {

DramSpec spec_of(Cycles latency) {
  DramSpec spec;
  spec.latency = latency;
  spec.bytes_per_cycle = 16;
  return spec;
}

struct DramBench : testing::Test {
  ClockDomain domain;
  FixedDram dram;
  struct Requester : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Requester> socket{"socket"};
    explicit Requester(const sc_core::sc_module_name& name) : sc_module(name) {}
  } requester{"requester"};
  PayloadPool payloads{4096};

  DramBench(const sc_core::sc_time& period, Cycles latency)
      : domain("domain", period), dram("dram", spec_of(latency), domain) {
    requester.socket.bind(dram.from_cache);
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
  }
  /// Time of the last byte of a request made at `now`.
  Cycles done(Cycles now, std::uint32_t bytes, bool write = false) {
    tlm::tlm_generic_payload* payload = payloads.acquire(0, bytes, write);
    tlm::tlm_phase phase = tlm::BEGIN_REQ;
    sc_core::sc_time delay = domain.span(0, now);
    EXPECT_EQ(requester.socket->nb_transport_fw(*payload, phase, delay), tlm::TLM_COMPLETED);
    payload->release();
    EXPECT_EQ(delay.value() % domain.period().value(), 0U);
    return delay.value() / domain.period().value();
  }
};

struct DramTest : DramBench {
  DramTest() : DramBench(one_nanosecond(), 100) {}
};

// 1.001 kHz, where 10^7 cycles are more picoseconds than a double has digits.
struct SlowClockDram : DramBench {
  SlowClockDram() : DramBench(sc_core::sc_time::from_value(999'000'999), 10'000'000) {}
};

TEST_F(DramTest, UnloadedRequestTakesLatencyPlusTransfer) {
  EXPECT_EQ(done(10, 64), 114U);
}

TEST_F(DramTest, TransferIsRoundedUpToWholeCycles) {
  EXPECT_EQ(done(10, 65), 115U);
}

TEST_F(DramTest, SecondRequestWaitsForTheBus) {
  done(10, 64);
  EXPECT_EQ(done(10, 64), 118U);
}

TEST_F(DramTest, RequestOneTransferLaterDoesNotWait) {
  done(10, 64);
  EXPECT_EQ(done(14, 64), 118U);
}

TEST_F(DramTest, WritesTakeBandwidthToo) {
  done(10, 64, true);
  EXPECT_EQ(done(10, 64), 118U);
}

TEST_F(DramTest, PeakBandwidthIsReachedAndNotExceeded) {
  Cycles last = 0;
  for (int i = 0; i < 1000; ++i) last = done(0, 64);
  EXPECT_EQ(last, 100U + 1000U * 4U);
  EXPECT_EQ(dram.stats(last).bus_busy_cycles, 4000U);
}

TEST_F(SlowClockDram, TimesAreWholeCyclesHoweverLong) {
  for (Cycles i = 1; i < 8; ++i) EXPECT_EQ(done(0, 16), 10'000'000 + i);
}

TEST_F(SlowClockDram, AnswerThatSystemcCannotSayIsRefused) {
  const Cycles last = ~std::uint64_t{0} / 999'000'999 - 1;
  EXPECT_EQ(done(last - 10'000'001, 16), last);
  try {
    done(last - 10'000'001, 16);  // behind the one before
    ADD_FAILURE() << "answered";
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("clock.frequency")) << error.what();
  }
}

}  // namespace
}  // namespace sheaf::test
