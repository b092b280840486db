// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

using C = DramCommand;

TEST(DramScheduling, RowHitGoesBeforeAnOlderConflict) {
  ChannelBench bench(ddr4());
  bench.read(0, {.row = 1}).read(1, {.row = 2}).read(2, {.row = 1, .column = 1}).run();
  EXPECT_LT(bench.done_at(2), bench.done_at(1));
}

TEST(DramScheduling, OfTwoRowHitsTheOlderGoesFirst) {
  ChannelBench bench(ddr4());
  bench.read(0, {.row = 1}).read(1, {.row = 1, .column = 9}).read(2, {.row = 1, .column = 5}).run();
  EXPECT_LT(bench.done_at(1), bench.done_at(2));
}

TEST(DramScheduling, ConflictIsNotOvertakenMoreOftenThanTheCap) {
  for (const std::uint32_t cap : {1U, 4U, 16U}) {
    ChannelBench bench(ddr4([&](DramSpec& s) {
      s.row_hit_cap = cap;
      s.read_queue = 64;
    }));
    bench.read(0, {.row = 1}).read(1, {.row = 2});
    for (std::uint32_t i = 0; i < 40; ++i) bench.read(2, {.row = 1, .column = i});
    bench.run();
    std::uint32_t before = 0;
    for (std::uint32_t i = 2; i < 42; ++i) before += bench.done_at(i) < bench.done_at(1) ? 1 : 0;
    // The first request opens the row while the second already waits, and counts too.
    EXPECT_EQ(before, cap);
  }
}

TEST(DramScheduling, WithoutCapAllRowHitsGoFirst) {
  ChannelBench bench(ddr4([](DramSpec& s) {
    s.row_hit_cap = 0;
    s.read_queue = 64;
  }));
  bench.read(0, {.row = 1}).read(1, {.row = 2});
  for (std::uint32_t i = 0; i < 40; ++i) bench.read(2, {.row = 1, .column = i});
  bench.run();
  for (std::uint32_t i = 2; i < 42; ++i) EXPECT_LT(bench.done_at(i), bench.done_at(1));
}

TEST(DramScheduling, ReadsGoBeforeWritesUntilTheHighMark) {
  ChannelBench bench(ddr4());
  for (std::uint32_t i = 0; i < 10; ++i) bench.write(0, {.group = 1, .column = i});
  for (std::uint32_t i = 0; i < 10; ++i) bench.read(0, {.group = 2, .column = i});
  bench.run();
  EXPECT_LT(bench.done_at(19), bench.done_at(0));
}

TEST(DramScheduling, AtTheHighMarkWritesAreDrainedToTheLowMark) {
  ChannelBench bench(ddr4());  // 24 and 8
  for (std::uint32_t i = 0; i < 24; ++i) bench.write(0, {.group = 1, .column = i});
  for (std::uint32_t i = 0; i < 4; ++i) bench.read(0, {.group = 2, .column = i});
  bench.run();
  std::uint32_t writes_first = 0;
  for (std::uint32_t i = 0; i < 24; ++i) {
    writes_first += bench.done_at(i) < bench.done_at(24) ? 1 : 0;
  }
  EXPECT_EQ(writes_first, 16U);
  EXPECT_EQ(bench.stats().num_turnarounds, 2U);
}

TEST(DramScheduling, ReadOfAQueuedWriteTouchesNoBank) {
  ChannelBench bench(ddr4());
  bench.read(0, {.group = 3}).write(0, {.row = 1}).read(0, {.row = 1}).run();
  EXPECT_EQ(bench.stats().num_forwarded, 1U);
  EXPECT_EQ(bench.done_at(2), 0U + 1 + 17 + 4);
  EXPECT_EQ(bench.stats().num_read_bursts, 1U);
}

TEST(DramScheduling, WriteOfAQueuedWriteReplacesIt) {
  ChannelBench bench(ddr4());
  bench.read(0, {.group = 3}).write(0, {.row = 1}).write(0, {.row = 1}).run();
  EXPECT_EQ(bench.stats().num_merged, 1U);
  EXPECT_EQ(bench.stats().num_write_bursts, 1U);
}

TEST(DramScheduling, ArrivalThatFindsTheQueueFullWaitsForAColumnCommand) {
  ChannelBench bench(ddr4([](DramSpec& s) { s.read_queue = 2; }));
  for (std::uint32_t i = 0; i < 3; ++i) bench.read(0, {.row = 1, .column = i});
  bench.run();
  ASSERT_EQ(bench.done().size(), 3U);
  EXPECT_EQ(bench.done()[2].accepted, bench.at(C::kRead, 0));
  EXPECT_EQ(bench.stats().max_queued, 2U);
}

TEST(DramScheduling, ClosedPageClosesAfterTheLastQueuedHit) {
  ChannelBench bench(ddr4([](DramSpec& s) { s.page = PagePolicy::kClosed; }));
  bench.read(0, {.row = 1}).read(0, {.row = 1, .column = 1}).read(500, {.row = 2}).run();
  EXPECT_NE(bench.at(C::kRead, 0), kNever);
  EXPECT_EQ(bench.at(C::kReadPrecharge, 0), bench.at(C::kRead, 0) + 6);
  EXPECT_EQ(bench.at(C::kPrecharge), kNever);
  EXPECT_EQ(bench.done_at(2), 500U + 1 + 17 + 17 + 4) << "the bank was closed in time";
}

TEST(DramScheduling, OutcomesAreHitMissAndConflict) {
  ChannelBench bench(ddr4());
  bench.read(0, {.row = 1}).read(300, {.row = 1, .column = 1}).read(600, {.row = 2}).run();
  EXPECT_EQ(bench.stats().num_row_misses, 1U);
  EXPECT_EQ(bench.stats().num_row_hits, 1U);
  EXPECT_EQ(bench.stats().num_row_conflicts, 1U);
}

TEST(DramScheduling, FirstAccessAfterARefreshIsAMiss) {
  ChannelBench bench(ddr4());
  bench.read(9000, {.row = 1}).read(10000, {.row = 2}).run();
  EXPECT_EQ(bench.stats().num_row_misses, 2U);
  EXPECT_EQ(bench.stats().num_row_conflicts, 0U);
}

TEST(DramScheduling, RanksAreRefreshedInTurn) {
  ChannelBench bench(ddr4([](DramSpec& s) { s.ranks = 2; }));
  bench.read(20000, {}).run();
  EXPECT_EQ(bench.at(C::kRefresh, 0), 4680U);
  EXPECT_EQ(bench.at(C::kRefresh, 1), 9360U);
}

TEST(DramScheduling, OtherRankGoesOnDuringARefresh) {
  ChannelBench bench(ddr4([](DramSpec& s) { s.ranks = 2; }));
  bench.read(4700, {.rank = 1}).run();
  EXPECT_EQ(bench.done_at(0), 4700U + 39);
}

TEST(DramScheduling, RequestOfSeveralBurstsIsDoneWithItsLast) {
  DramSpec spec = ddr4_spec();
  spec.model = DramModel::kLpddr5_6400;
  const DramDevice device = resolve_dram(spec);
  DramChannel channel(device);
  std::vector<DramDone> done;
  channel.push({.arrival = 0, .bursts = 2});
  channel.advance(kNever, done);
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(done[0].at, 1U + 15 + 4 + 17 + 2) << "the second burst follows tCCD_L after the first";
  EXPECT_EQ(channel.stats(done[0].at).num_row_misses, 1U);
  EXPECT_EQ(channel.stats(done[0].at).num_row_hits, 0U);
}

}  // namespace
}  // namespace sheaf::test
