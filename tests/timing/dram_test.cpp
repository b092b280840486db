// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include "memory/fixed_dram.h"
#include "memory/payload_pool.h"
#include "timing/bench.h"

namespace sheaf::test {
namespace {

struct DramTest : testing::Test {
  static DramSpec spec() {
    DramSpec spec;
    spec.latency = 100;
    spec.bytes_per_cycle = 16;
    return spec;
  }
  FixedDram dram{"dram", spec(), one_nanosecond()};
  struct Requester : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Requester> socket{"socket"};
    explicit Requester(const sc_core::sc_module_name& name) : sc_module(name) {}
  } requester{"requester"};
  PayloadPool payloads{4096};

  DramTest() {
    requester.socket.bind(dram.from_cache);
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
  }
  /// Time of the last byte of a request made at `now`.
  Cycles done(Cycles now, std::uint32_t bytes, bool write = false) {
    tlm::tlm_generic_payload* payload = payloads.acquire(0, bytes, write);
    tlm::tlm_phase phase = tlm::BEGIN_REQ;
    sc_core::sc_time delay = one_nanosecond() * static_cast<double>(now);
    EXPECT_EQ(requester.socket->nb_transport_fw(*payload, phase, delay), tlm::TLM_COMPLETED);
    payload->release();
    return delay.value() / one_nanosecond().value();
  }
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

}  // namespace
}  // namespace sheaf::test
