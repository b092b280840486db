// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Ports, targets, sectors, write policies and the write buffer of the L2.

#include <gtest/gtest.h>

#include "timing/l2_bench.h"

namespace sheaf::test {
namespace {

using Times = std::vector<Cycles>;

TEST_F(L2Test, TwoPortsTakeTwoRequestsACycleAndTheThirdWaits) {
  L2Spec two = spec();
  two.ports = 2;
  two.mshrs = 4;
  build(two);
  for (const std::uint64_t line : {0, 2, 4}) read_at(0, line);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads, (Times{20, 20, 21}));
}

TEST_F(L2Test, PortsAreFreeAgainAfterABlockedBankIsReleased) {
  L2Spec two = spec();
  two.ports = 2;
  build(two);
  for (const std::uint64_t line : {0, 2, 4, 6}) read_at(0, line);
  sc_core::sc_start();
  const Cycles freed = 20 + kDramLatency;
  EXPECT_EQ(dram.reads, (Times{20, 20, freed + 12, freed + 12}));
}

TEST_F(L2Test, AsManyRequestsWaitForALineAsItsMshrTakes) {
  L2Spec limited = spec();
  limited.mshr_targets = 2;
  build(limited);
  for (std::uint16_t cache = 0; cache < 3; ++cache) read_at(0, 4, cache);
  sc_core::sc_start();
  ASSERT_EQ(arrived.size(), 3U);
  EXPECT_EQ(arrival(1), 20U + kDramLatency + 8U);
  EXPECT_EQ(arrived[2].cache, 2U);  // hits the line that the others waited for
  EXPECT_EQ(arrival(2), 20U + kDramLatency + 12U + 8U);
  EXPECT_EQ(l2->stats().num_target_stalls, 1U);
}

TEST_F(L2Test, SectorsAreFetchedOneByOne) {
  L2Spec sectored = spec();
  sectored.line = 128;
  sectored.sectors = 2;
  build(sectored);
  read_at(0, 4);
  read_at(1000, 5);  // same line, other sector
  read_at(2000, 4);
  sc_core::sc_start();
  EXPECT_EQ(dram.reads, (Times{20, 1020}));
  EXPECT_EQ(dram.read_bytes, (std::vector<Bytes>{64, 64}));
  EXPECT_EQ(l2->stats().num_hits, 1U);
}

TEST_F(L2Test, OnlyDirtySectorsOfAVictimAreWritten) {
  L2Spec sectored = spec();
  sectored.line = 128;
  sectored.sectors = 2;
  sectored.ways = 1;  // 4 sets a bank: lines of 128 bytes 0 and 8 share a set
  build(sectored);
  for (const std::uint64_t sector : {0, 1}) read_at(0, sector);
  write_at(500, 1);
  read_at(1000, 16);
  sc_core::sc_start();
  EXPECT_EQ(dram.written, (std::vector<Address>{64}));
}

TEST_F(L2Test, WriteThroughPassesAWrittenHitOn) {
  L2Spec through = spec();
  through.write.policy = WritePolicy::kThrough;
  build(through);
  read_at(0, 0);
  write_at(500, 0);
  for (const std::uint64_t line : {8, 16}) read_at(1000, line);
  sc_core::sc_start();
  EXPECT_EQ(dram.writes, (Times{520}));  // and none when the line leaves
  EXPECT_EQ(l2->stats().num_writebacks, 0U);
}

TEST_F(L2Test, WriteAllocateKeepsAWholeLineWithoutFetchingIt) {
  L2Spec allocate = spec();
  allocate.write.allocate = true;
  build(allocate);
  write_at(0, 4);
  read_at(100, 4);
  sc_core::sc_start();
  EXPECT_TRUE(dram.reads.empty());
  EXPECT_TRUE(dram.writes.empty());
  EXPECT_EQ(arrival(0), 100U + 28U);
}

TEST_F(L2Test, WriteAllocateFetchesALineThatIsWrittenInPart) {
  L2Spec allocate = spec();
  allocate.write.allocate = true;
  allocate.ways = 1;
  build(allocate);
  send_at(0, {4 * 64 + 16, 16, 0, DataKind::kPixel, true, false});
  read_at(500, 4);
  read_at(1000, 20);  // of the same set
  sc_core::sc_start();
  EXPECT_EQ(dram.reads.front(), 20U);
  EXPECT_EQ(arrival(0), 500U + 28U);
  EXPECT_EQ(dram.written, (std::vector<Address>{4 * 64}));
}

TEST_F(L2Test, FullWriteBufferHoldsTheBankUpUntilAWriteIsDone) {
  L2Spec bounded = spec();
  bounded.write.buffer = 2;
  build(bounded);
  for (const std::uint64_t line : {0, 2, 4}) write_at(0, line);
  sc_core::sc_start();
  EXPECT_EQ(dram.writes, (Times{20, 21, 20 + kDramLatency + 12}));
}

TEST_F(L2Test, OtherBankGoesOnWhileAWriteBufferIsFull) {
  L2Spec bounded = spec();
  bounded.write.buffer = 1;
  build(bounded);
  for (const std::uint64_t line : {0, 2, 1}) write_at(0, line);
  sc_core::sc_start();
  EXPECT_EQ(dram.writes, (Times{20, 20, 20 + kDramLatency + 12}));
}

TEST_F(L2Test, WriteIsAcknowledgedAfterTheTagCheck) {
  build(spec());
  send_at(0, {0, 64, 1, DataKind::kPixel, true, true});
  sc_core::sc_start();
  ASSERT_EQ(arrived.size(), 1U);
  EXPECT_TRUE(arrived[0].of_write);
  EXPECT_EQ(arrived[0].cache, 1U);
  EXPECT_EQ(arrival(0), 28U);
}

TEST_F(L2Test, LittlesLawHoldsForQueuesAndMshrs) {
  build(spec());
  for (Cycles t = 0; t < 300; ++t) read_at(t, t * 7 % 64, static_cast<std::uint16_t>(t % 3));
  sc_core::sc_start();
  EXPECT_GT(l2->stats().bank_wait_cycles, 1000U);
  EXPECT_EQ(l2->stats().queue_occupancy_cycles, l2->stats().bank_wait_cycles);
  EXPECT_GT(l2->stats().sum_miss_latency, 1000U);
  EXPECT_EQ(l2->stats().mshr_occupancy_cycles, l2->stats().sum_miss_latency);
}

}  // namespace
}  // namespace sheaf::test
