// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "timing/l2_bench.h"

namespace sheaf::test {
namespace {

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
