// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/banked_dram.h"

#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <map>

#include "config/parameters.h"
#include "memory/l2_cache.h"
#include "memory/payload_pool.h"
#include "timing/bench.h"

namespace sheaf::test {
namespace {

DramDevice ddr4() {
  Config config;
  static_cast<void>(declare_parameters(config));
  config.dram.model = DramModel::kDdr4_2400;
  return resolve_dram(config.dram);
}

struct BankedDramTest : testing::Test {
  ClockDomain domain{"domain", one_nanosecond()};
  Actor actor{domain};
  BankedDram dram{"dram", ddr4(), 1e9, domain};
  PayloadPool payloads{4096};
  std::map<Address, Cycles> answered;

  struct Requester : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Requester> socket{"socket"};
    BankedDramTest& test;
    Requester(const sc_core::sc_module_name& name, BankedDramTest& owner)
        : sc_module(name), test(owner) {
      socket.register_nb_transport_bw(this, &Requester::answer);
    }
    tlm::tlm_sync_enum answer(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                              sc_core::sc_time& delay) {
      EXPECT_EQ(phase, tlm::BEGIN_RESP);
      EXPECT_TRUE(payload.is_response_ok());
      test.answered[payload.get_address()] = test.domain.cycle_at_kernel_offset(delay);
      payload.release();
      return tlm::TLM_COMPLETED;
    }
  } requester{"requester", *this};

  BankedDramTest() { requester.socket.bind(dram.from_cache); }

  void request(Cycles time, Address address, bool write = false, std::uint32_t bytes = 64) {
    actor.at(time, [=, this] {
      tlm::tlm_generic_payload* payload = payloads.acquire(address, bytes, write);
      tlm::tlm_phase phase = tlm::BEGIN_REQ;
      sc_core::sc_time delay = domain.offset(time + 1);
      EXPECT_EQ(requester.socket->nb_transport_fw(*payload, phase, delay), tlm::TLM_UPDATED);
      EXPECT_EQ(phase, tlm::END_REQ);
    });
  }
};

// At 1 GHz and 1.2 GHz: cycle 10 is tCK 12; 1 + 17 + 17 + 4 later is tCK 51, at 42.5 ns.
TEST_F(BankedDramTest, IdleBankAnswersAtTheFirstCoreCycleAfterItsLastByte) {
  request(9, 0);
  sc_core::sc_start();
  EXPECT_EQ(answered.at(0), 43U);
}

TEST_F(BankedDramTest, RequestIsSeenAtTheNextTickOfTheMemory) {
  request(10, 0);  // arrives at 11 ns, 13.2 tCK: seen at 14, done at 53, 44.17 ns
  sc_core::sc_start();
  EXPECT_EQ(answered.at(0), 45U);
}

TEST_F(BankedDramTest, OpenRowAnswersEarlier) {
  request(9, 0);
  request(99, 64);  // tCK 120 + 1 + 17 + 4 = 142, 118.33 ns
  sc_core::sc_start();
  EXPECT_EQ(answered.at(64), 119U);
}

TEST_F(BankedDramTest, ShortRequestTakesAWholeBurstAndALongOneSeveral) {
  request(9, 0, false, 16);
  request(199, 4096, false, 256);  // same row: tCK 240 + 1 + 17 + 3 * 6 + 4 = 280, 233.33 ns
  sc_core::sc_start();
  EXPECT_EQ(answered.at(0), 43U);
  EXPECT_EQ(answered.at(4096), 234U);
  EXPECT_EQ(dram.stats(1000).bytes_read, 16U + 256U);
}

TEST_F(BankedDramTest, RequestsBeyondTheQueueWaitAndAreAllAnswered) {
  for (Address i = 0; i < 200; ++i) request(9, i * 0x20000);  // one bank, all rows different
  sc_core::sc_start();
  EXPECT_EQ(answered.size(), 200U);
  EXPECT_GE(answered.at(199 * 0x20000), 199U * 56 * 10 / 12);
}

TEST_F(BankedDramTest, WritesAreAnsweredToo) {
  request(9, 0, true);
  request(9, 64, true);
  sc_core::sc_start();
  EXPECT_EQ(answered.size(), 2U);
  EXPECT_EQ(dram.stats(1000).num_writes, 2U);
}

TEST_F(BankedDramTest, MeanLatencyIsCountedInCoreCycles) {
  request(9, 0);
  sc_core::sc_start();
  EXPECT_EQ(dram.stats(1000).sum_read_latency, 33U);
  EXPECT_EQ(dram.stats(1000).bus_busy_cycles, 4U) << "4 tCK are 3.33 ns";
}

/// An L2 whose memory answers later, by BEGIN_RESP on the backward path: the banked one, or one
/// with a SystemC process of its own.
struct LateMemory : testing::Test {
  ClockDomain domain{"domain", one_nanosecond()};
  Actor requester{domain};
  TimedChannel<LineRequest> requests{
      "requests", {.capacity = TimedChannel<LineRequest>::kUnbounded, .latency = 8, .interval = 0}};
  TimedChannel<LineResponse> responses{
      "responses",
      {.capacity = TimedChannel<LineResponse>::kUnbounded, .latency = 8, .interval = 1}};
  L2Cache l2{"l2",
             {.mode = CacheMode::kNormal,
              .capacity = 1024,
              .line = 64,
              .ways = 2,
              .banks = 2,
              .mshrs = 2,
              .hit_latency = 12},
             domain};
  std::vector<std::pair<Cycles, Address>> arrived;

  LateMemory() {
    l2.in_requests(requests);
    l2.out_responses(responses);
    responses.set_consumer(requester.inbox());
    requester.always([this](Cycles now) {
      while (responses.has_arrived(now)) {
        arrived.emplace_back(now, responses.read(now).address);
      }
      if (responses.next_arrival() != kNever) requester.inbox().nudge(responses.next_arrival());
    });
  }
  void read_at(Cycles time, std::uint64_t line) {
    requester.at(time, [=, this] {
      requests.nb_write({line * 64, 64, 0, DataKind::kNode, false}, time);
    });
  }
  void write_at(Cycles time, std::uint64_t line) {
    requester.at(time, [=, this] {
      requests.nb_write({line * 64, 64, 0, DataKind::kPixel, true}, time);
    });
  }
};

TEST_F(LateMemory, MissTakesLinkTagCheckBanksAndLink) {
  BankedDram dram("dram", ddr4(), 1e9, domain);
  l2.to_dram.bind(dram.from_cache);
  read_at(0, 4);  // asked at 20 ns, tCK 24; last byte at tCK 63, 52.5 ns
  sc_core::sc_start();
  ASSERT_EQ(arrived.size(), 1U);
  EXPECT_EQ(arrived[0].first, 53U + 8U);
  EXPECT_TRUE(l2.is_idle());
}

TEST_F(LateMemory, HitUnderAMissIsAnsweredFirst) {
  BankedDram dram("dram", ddr4(), 1e9, domain);
  l2.to_dram.bind(dram.from_cache);
  read_at(0, 4);
  read_at(200, 6);
  read_at(201, 4);
  sc_core::sc_start();
  ASSERT_EQ(arrived.size(), 3U);
  EXPECT_EQ(arrived[1].second, 4U * 64U);
  EXPECT_EQ(arrived[1].first, 201U + 28U);
}

TEST_F(LateMemory, WritesAreAcknowledgedAndLeaveNothingBehind) {
  BankedDram dram("dram", ddr4(), 1e9, domain);
  l2.to_dram.bind(dram.from_cache);
  for (std::uint64_t line = 0; line < 64; ++line) write_at(line, line);
  sc_core::sc_start();
  EXPECT_TRUE(l2.is_idle());
  EXPECT_EQ(dram.stats(10'000).num_writes, 64U);
  EXPECT_EQ(dram.stuck_reason(), "");
}

/// Answers each request 50 ns after it, from its own process.
struct ProcessMemory : sc_core::sc_module {
  tlm_utils::simple_target_socket<ProcessMemory> socket{"socket"};
  std::multimap<sc_core::sc_time, tlm::tlm_generic_payload*> pending;
  sc_core::sc_event event;

  explicit ProcessMemory(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(ProcessMemory);
    SC_METHOD(answer);
    sensitive << event;
    dont_initialize();
    socket.register_nb_transport_fw(this, &ProcessMemory::take);
  }
  tlm::tlm_sync_enum take(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                          sc_core::sc_time& delay) {
    pending.emplace(sc_core::sc_time_stamp() + delay + 50 * one_nanosecond(), &payload);
    event.cancel();
    event.notify(pending.begin()->first - sc_core::sc_time_stamp());
    phase = tlm::END_REQ;
    return tlm::TLM_UPDATED;
  }
  void answer() {
    while (!pending.empty() && pending.begin()->first <= sc_core::sc_time_stamp()) {
      tlm::tlm_generic_payload* payload = pending.begin()->second;
      pending.erase(pending.begin());
      payload->set_response_status(tlm::TLM_OK_RESPONSE);
      tlm::tlm_phase phase = tlm::BEGIN_RESP;
      sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
      socket->nb_transport_bw(*payload, phase, delay);
    }
    if (!pending.empty()) event.notify(pending.begin()->first - sc_core::sc_time_stamp());
  }
};

TEST_F(LateMemory, MayBeASystemcProcess) {
  ProcessMemory memory("memory");
  l2.to_dram.bind(memory.socket);
  for (std::uint64_t i = 0; i < 10; ++i) read_at(7 * i, i);
  read_at(1000, 2);
  sc_core::sc_start();
  ASSERT_EQ(arrived.size(), 11U);
  EXPECT_EQ(arrived[0].first, 8U + 12U + 50U + 8U);
  EXPECT_TRUE(l2.is_idle());
}

}  // namespace
}  // namespace sheaf::test
