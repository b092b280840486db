// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/l2_cache.h"

#include <gtest/gtest.h>
#include <tlm_utils/simple_target_socket.h>

#include "timing/bench.h"

namespace sheaf::test {
namespace {

constexpr Cycles kDramLatency = 50;

/// Answers every request after a fixed time, however many there are.
struct IdealDram : sc_core::sc_module {
  tlm_utils::simple_target_socket<IdealDram> socket{"socket"};
  std::vector<Cycles> reads;
  std::vector<Cycles> writes;

  explicit IdealDram(const sc_core::sc_module_name& name) : sc_module(name) {
    socket.register_nb_transport_fw(this, &IdealDram::transport);
  }
  tlm::tlm_sync_enum transport(tlm::tlm_generic_payload& payload, tlm::tlm_phase& /*phase*/,
                               sc_core::sc_time& delay) {
    const auto now = (sc_core::sc_time_stamp() + delay).value() / one_nanosecond().value();
    (payload.is_write() ? writes : reads).push_back(now);
    delay += one_nanosecond() * static_cast<double>(kDramLatency);
    return tlm::TLM_COMPLETED;
  }
};

struct L2Test : testing::Test {
  static L2Spec spec() {
    return {.mode = CacheMode::kNormal,
            .capacity = 1024,
            .line = 64,
            .ways = 2,
            .banks = 2,
            .mshrs = 2,
            .hit_latency = 12};
  }

  ClockDomain domain{"domain", one_nanosecond()};
  Actor requester{domain};
  TimedChannel<LineRequest> requests{
      "requests", {.capacity = TimedChannel<LineRequest>::kUnbounded, .latency = 8, .interval = 0}};
  TimedChannel<LineResponse> responses{
      "responses",
      {.capacity = TimedChannel<LineResponse>::kUnbounded, .latency = 8, .interval = 1}};
  IdealDram dram{"dram"};
  std::unique_ptr<L2Cache> l2;
  std::vector<std::pair<Cycles, Address>> arrived;

  void build(const L2Spec& l2_spec) {
    l2 = std::make_unique<L2Cache>("l2", l2_spec, domain);
    l2->in_requests(requests);
    l2->out_responses(responses);
    l2->to_dram.bind(dram.socket);
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
  /// Arrival of the response to the n-th request.
  Cycles arrival(std::size_t n) { return arrived.at(n).first; }
};

TEST_F(L2Test, MissTakesLinkPlusTagCheckPlusDramPlusLink) {
  build(spec());
  read_at(0, 4);
  sc_core::sc_start();
  ASSERT_EQ(arrived.size(), 1U);
  EXPECT_EQ(arrival(0), 8U + 12U + kDramLatency + 8U);
}

TEST_F(L2Test, HitTakesLinkPlusHitLatencyPlusLink) {
  build(spec());
  read_at(0, 4);
  read_at(1000, 4);
  sc_core::sc_start();
  EXPECT_EQ(arrival(1), 1000U + 8U + 12U + 8U);
}

TEST_F(L2Test, SecondRequestToABusyBankWaitsOneCycle) {
  build(spec());
  read_at(0, 4);
  read_at(0, 6);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads, (std::vector<Cycles>{20, 21}));
}

TEST_F(L2Test, RequestsToDifferentBanksDoNotWait) {
  build(spec());
  read_at(0, 4);
  read_at(0, 5);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads, (std::vector<Cycles>{20, 20}));
}

TEST_F(L2Test, RequestsForAPendingLineShareOneDramRead) {
  build(spec());
  read_at(0, 4);
  read_at(5, 4);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads.size(), 1U);
  EXPECT_EQ(arrived.size(), 2U);
  EXPECT_EQ(l2->stats().num_merges, 1U);
}

TEST_F(L2Test, MissWithoutAFreeMshrWaitsForTheNextFill) {
  build(spec());
  for (const std::uint64_t line : {0, 2, 4}) read_at(0, line);
  sc_core::sc_start();
  ASSERT_EQ(dram.reads.size(), 3U);
  EXPECT_EQ(dram.reads[2], 20U + kDramLatency + 12U);
  EXPECT_EQ(l2->stats().num_mshr_stalls, 1U);
}

TEST_F(L2Test, HitBehindABlockedMissWaitsWithIt) {
  build(spec());
  read_at(0, 8);
  for (const std::uint64_t line : {0, 2, 4}) read_at(1000, line);
  read_at(1001, 8);
  sc_core::sc_start();
  EXPECT_GT(arrived.back().first, 1000U + kDramLatency);
}

TEST_F(L2Test, WriteToALineThatIsNotThereGoesToDram) {
  build(spec());
  write_at(0, 4);
  sc_core::sc_start();
  EXPECT_EQ(dram.writes, (std::vector<Cycles>{20}));
}

TEST_F(L2Test, WrittenLineGoesToDramWhenItIsReplaced) {
  build(spec());  // 4 sets a bank of 2 ways: lines 0, 8, 16 share a set
  read_at(0, 0);
  write_at(500, 0);
  read_at(1000, 8);
  read_at(2000, 16);
  sc_core::sc_start();
  ASSERT_EQ(dram.writes.size(), 1U);
  EXPECT_EQ(dram.writes[0], 2000U + 20U + kDramLatency + 12U);
}

TEST_F(L2Test, PerfectNeverAsksDram) {
  L2Spec perfect = spec();
  perfect.mode = CacheMode::kPerfect;
  build(perfect);
  read_at(0, 4);
  sc_core::sc_start();
  EXPECT_TRUE(dram.reads.empty());
  EXPECT_EQ(arrival(0), 28U);
}

TEST_F(L2Test, AbsentAsksDramEveryTime) {
  L2Spec absent = spec();
  absent.mode = CacheMode::kAbsent;
  build(absent);
  read_at(0, 4);
  read_at(1000, 4);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads.size(), 2U);
}

TEST_F(L2Test, AnswerOfAFillOvertakesNoEarlierHit) {
  build(spec());
  read_at(0, 4);
  // A hit checked just before the fill of another line comes in is answered after it.
  read_at(200, 6);
  read_at(200 + 20 + kDramLatency - 8 - 6, 4);
  sc_core::sc_start();
  ASSERT_EQ(arrived.size(), 3U);
  EXPECT_EQ(arrived[1].second, 6U * 64U);
  EXPECT_EQ(arrived[2].second, 4U * 64U);
}

}  // namespace
}  // namespace sheaf::test
