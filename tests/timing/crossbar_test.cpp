// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The crossbar between private caches and the banks of the L2: even lines lie in bank 0.

#include <gtest/gtest.h>

#include "timing/l2_bench.h"

namespace sheaf::test {
namespace {

using Times = std::vector<Cycles>;

struct CrossbarTest : L2Test {
  static L2Spec wide() {
    L2Spec wide = spec();
    wide.ports = 8;
    wide.mshrs = 16;
    return wide;
  }
};

TEST_F(CrossbarTest, SecondRequestOfACacheCrossesACycleLater) {
  build(wide(), {.request_width = 32});
  read_at(0, 0);
  read_at(0, 1);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads, (Times{20, 21}));
}

TEST_F(CrossbarTest, RequestsOfTwoCachesToTwoBanksCrossTogether) {
  build(wide(), {.request_width = 32});
  read_at(0, 0, 0);
  read_at(0, 1, 1);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads, (Times{20, 20}));
}

TEST_F(CrossbarTest, BankTakesOneOfTwoCachesTheLowerFirst) {
  build(wide(), {.request_width = 32});
  read_at(0, 0, 2);
  read_at(0, 2, 1);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads, (Times{20, 21}));
  EXPECT_EQ(arrived[0].cache, 1U);
}

TEST_F(CrossbarTest, OlderRequestGoesBeforeTheLowerCache) {
  build(wide(), {.request_width = 16});
  write_at(0, 0, 0);  // takes bank 0 for four cycles
  read_at(1, 2, 2);
  read_at(2, 4, 1);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads, (Times{24, 25}));
  EXPECT_EQ(arrived[0].cache, 2U);
}

TEST_F(CrossbarTest, WrittenDataTakeTheirWidth) {
  build(wide(), {.request_width = 32});
  write_at(0, 0);
  read_at(0, 1);
  sc_core::sc_start();
  EXPECT_EQ(dram.writes, (Times{20}));
  EXPECT_EQ(dram.reads, (Times{22}));
}

TEST_F(CrossbarTest, WideEnoughAWriteTakesOneCycle) {
  build(wide(), {.request_width = 64});
  write_at(0, 0);
  read_at(0, 1);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads, (Times{21}));
}

TEST_F(CrossbarTest, FullBankQueueHoldsUpThatCachesNextRequest) {
  L2Spec narrow = spec();  // one port, two MSHRs
  build(narrow, {.request_width = 32, .depth = 1});
  for (const std::uint64_t line : {0, 2, 4, 6}) read_at(0, line, 0);
  read_at(0, 1, 0);  // to the other bank, behind them
  read_at(0, 3, 1);  // of another cache
  sc_core::sc_start();
  const Cycles freed = 20 + kDramLatency;  // an MSHR of bank 0
  // 4 waits in the bank's queue and 6, which finds it full, before the crossbar with 1 behind it.
  EXPECT_EQ(dram.reads, (Times{20, 20, 21, freed + 12, freed + 12 + 1, freed + 12 + 1}));
  EXPECT_EQ(l2->request_crossbar()->stats().max_waiting, 6U);
}

TEST_F(CrossbarTest, DeepEnoughABankQueueHoldsNobodyUp) {
  L2Spec narrow = spec();
  build(narrow, {.request_width = 32, .depth = 2});
  for (const std::uint64_t line : {0, 2, 4, 6}) read_at(0, line, 0);
  read_at(0, 1, 0);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads[2], 24U);
}

TEST_F(CrossbarTest, SecondLineOfABankLeavesWhenTheFirstHas) {
  build(wide(), {.response_width = 16});
  for (const std::uint64_t line : {0, 2}) read_at(0, line);
  read_at(1000, 0, 0);
  read_at(1000, 2, 1);
  sc_core::sc_start();
  EXPECT_EQ(arrival(2), 1000U + 28U);
  EXPECT_EQ(arrival(3), 1000U + 28U + 4U);
}

TEST_F(CrossbarTest, LinesOfTwoBanksLeaveTogether) {
  build(wide(), {.response_width = 16});
  for (const std::uint64_t line : {0, 1}) read_at(0, line);
  read_at(1000, 0, 0);
  read_at(1000, 1, 1);
  sc_core::sc_start();
  EXPECT_EQ(arrival(3), 1000U + 28U);
}

TEST_F(CrossbarTest, LineThatIsReadyEarlierLeavesFirstThoughAskedForLater) {
  build(wide(), {.response_width = 16});
  read_at(0, 0);
  const Cycles filled = 1000 + 20 + kDramLatency;
  read_at(1000, 2, 1);
  read_at(filled - 8 - 6, 0, 0);  // a hit that is ready 6 cycles after the fill
  sc_core::sc_start();
  EXPECT_EQ(arrived[1].cache, 1U);
  EXPECT_EQ(arrival(1), filled + 8);
  EXPECT_EQ(arrival(2), filled + 6 + 8);
}

TEST_F(CrossbarTest, WordThatAWriteWasTakenDoesNotOvertakeALineReadyBeforeIt) {
  build(wide(), {.response_width = 16});
  for (const std::uint64_t line : {0, 2}) read_at(0, line);
  for (const std::uint64_t line : {0, 2}) read_at(1000, line);  // the second leaves in 1024
  send_at(1004, {64, 64, 0, DataKind::kPixel, true, true});     // taken in 1012, ready in 1024
  sc_core::sc_start();
  ASSERT_EQ(arrived.size(), 5U);
  EXPECT_EQ(arrival(3), 1024U + 8U);
  EXPECT_EQ(arrived[3].second, 2U * 64U);
  EXPECT_EQ(arrival(4), 1024U + 9U);
  EXPECT_TRUE(arrived[4].of_write);
}
TEST_F(CrossbarTest, LittlesLawHoldsBeforeTheCrossbar) {
  build(spec(), {.request_width = 16, .response_width = 16, .depth = 2});
  for (Cycles t = 0; t < 200; ++t) {
    const auto cache = static_cast<std::uint16_t>(t % 3);
    t % 5 == 0 ? write_at(t, t * 7 % 64, cache) : read_at(t, t * 11 % 64, cache);
  }
  sc_core::sc_start();
  const RequestCrossbarStats& stats = l2->request_crossbar()->stats();
  EXPECT_EQ(stats.num_requests, 200U);
  EXPECT_GT(stats.wait_cycles, 1000U);
  EXPECT_EQ(stats.occupancy_cycles, stats.wait_cycles);
  EXPECT_TRUE(l2->is_idle());
}

}  // namespace
}  // namespace sheaf::test
