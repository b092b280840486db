// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/private_cache.h"

#include <gtest/gtest.h>

#include "timing/bench.h"

namespace sheaf::test {
namespace {

using Result = PrivateCache::Result;

CacheSpec small_cache() {
  return {.mode = CacheMode::kNormal,
          .capacity = 256,
          .line = 64,
          .ways = 2,
          .mshrs = 2,
          .hit_latency = 2};
}

struct PrivateCacheTest : testing::Test {
  ClockDomain domain{"domain", one_nanosecond()};
  Actor memory{domain};
  TimedChannel<LineRequest> requests{
      "requests", {.capacity = TimedChannel<LineRequest>::kUnbounded, .latency = 1, .interval = 0}};

  PrivateCacheTest() { requests.set_consumer(memory.inbox()); }
  Result read(PrivateCache& cache, std::uint64_t line, int waiter = 0, Cycles now = 0) {
    return cache.read(line, DataKind::kNode, waiter, now);
  }
  Result modify(PrivateCache& cache, std::uint64_t line, Cycles now = 0) {
    return cache.modify(line * 64 + 16, 16, DataKind::kPixel, 0, now);
  }
  /// A write taken by the next level.
  std::uint64_t acknowledge(PrivateCache& cache) {
    std::uint64_t retry = 0;
    cache.fill({LineResponse::kWriteTaken}, 0, retry);
    return retry;
  }
  std::uint64_t fill(PrivateCache& cache, std::uint64_t line, Cycles now = 0) {
    std::uint64_t retry = 0;
    return cache.fill({line * 64}, now, retry);
  }
};

TEST_F(PrivateCacheTest, LineHitsOnlyOnceItHasBeenFilled) {
  PrivateCache cache(small_cache(), requests, 0);
  EXPECT_EQ(read(cache, 5), Result::kPending);
  EXPECT_EQ(fill(cache, 5), 1U);
  EXPECT_EQ(read(cache, 5), Result::kHit);
}

TEST_F(PrivateCacheTest, SecondAccessToAPendingLineMergesAndSendsNoRequest) {
  PrivateCache cache(small_cache(), requests, 0);
  read(cache, 5, 0);
  EXPECT_EQ(read(cache, 5, 3), Result::kPending);
  EXPECT_EQ(requests.num_written(), 1U);
  EXPECT_EQ(fill(cache, 5), 0b1001U);
  EXPECT_EQ(cache.stats().num_merges, 1U);
}

TEST_F(PrivateCacheTest, WaitsForAnMshrUntilAFillFreesOne) {
  PrivateCache cache(small_cache(), requests, 0);
  read(cache, 1, 0);
  read(cache, 2, 1);
  EXPECT_EQ(read(cache, 3, 2), Result::kNoMshr);
  std::uint64_t retry = 0;
  cache.fill({64}, 0, retry);
  EXPECT_EQ(retry, 0b100U);
  EXPECT_EQ(read(cache, 3, 2), Result::kPending);
}

TEST_F(PrivateCacheTest, ReplacesTheLeastRecentlyUsedWay) {
  PrivateCache cache(small_cache(), requests, 0);  // two sets of two ways
  for (const std::uint64_t line : {0, 2}) {
    read(cache, line);
    fill(cache, line);
  }
  EXPECT_EQ(read(cache, 0), Result::kHit);
  read(cache, 4);
  fill(cache, 4);
  EXPECT_EQ(read(cache, 0), Result::kHit);
  EXPECT_EQ(read(cache, 2), Result::kPending);
}

TEST_F(PrivateCacheTest, WritesAModifiedLineBackWhenItLeaves) {
  PrivateCache cache(small_cache(), requests, 0);
  modify(cache, 0);
  fill(cache, 0);
  for (const std::uint64_t line : {2, 4}) {
    read(cache, line);
    fill(cache, line);
  }
  EXPECT_EQ(cache.stats().num_writebacks, 1U);
  EXPECT_EQ(cache.stats().bytes_written, 64U);
}

TEST_F(PrivateCacheTest, CountsEveryAccessOnce) {
  PrivateCache cache(small_cache(), requests, 0);
  read(cache, 1, 0);
  read(cache, 2, 1);
  read(cache, 1, 2);
  read(cache, 3, 3);  // no MSHR: not an access yet
  fill(cache, 1);
  read(cache, 1, 0);
  EXPECT_EQ(cache.stats().num_accesses, 4U);
  EXPECT_EQ(cache.stats().num_hits + cache.stats().num_misses + cache.stats().num_merges, 4U);
}

TEST_F(PrivateCacheTest, PerfectAlwaysHitsAndAsksForNothing) {
  CacheSpec spec = small_cache();
  spec.mode = CacheMode::kPerfect;
  PrivateCache cache(spec, requests, 0);
  for (std::uint64_t line = 0; line < 100; ++line) EXPECT_EQ(read(cache, line), Result::kHit);
  EXPECT_EQ(requests.num_written(), 0U);
}

TEST_F(PrivateCacheTest, AbsentNeverHits) {
  CacheSpec spec = small_cache();
  spec.mode = CacheMode::kAbsent;
  PrivateCache cache(spec, requests, 0);
  read(cache, 1);
  fill(cache, 1);
  EXPECT_EQ(read(cache, 1), Result::kPending);
}

TEST_F(PrivateCacheTest, TakesAsManyAccessesToAPendingLineAsItsMshrHasTargets) {
  CacheSpec spec = small_cache();
  spec.mshr_targets = 2;
  PrivateCache cache(spec, requests, 0);
  EXPECT_EQ(read(cache, 5, 0), Result::kPending);
  EXPECT_EQ(read(cache, 5, 1), Result::kPending);
  EXPECT_EQ(read(cache, 5, 2), Result::kNoMshr);
  EXPECT_EQ(cache.stats().num_target_stalls, 1U);
  std::uint64_t retry = 0;
  EXPECT_EQ(cache.fill({5 * 64}, 0, retry), 0b11U);
  EXPECT_EQ(retry, 0b100U);
  EXPECT_EQ(read(cache, 5, 2), Result::kHit);
}

TEST_F(PrivateCacheTest, FetchesASector) {
  CacheSpec spec = small_cache();
  spec.sectors = 2;
  PrivateCache cache(spec, requests, 0);
  EXPECT_EQ(cache.line_size(), 32U);
  EXPECT_EQ(cache.line_of(32), 1U);
  read(cache, 0);
  EXPECT_EQ(cache.stats().bytes_read, 32U);
  std::uint64_t retry = 0;
  cache.fill({0}, 0, retry);
  EXPECT_EQ(read(cache, 0), Result::kHit);
  EXPECT_EQ(read(cache, 1), Result::kPending);  // the other half of the line
}

TEST_F(PrivateCacheTest, LookUpsOfNeighboursTakeACycleAPort) {
  CacheSpec spec = small_cache();
  EXPECT_EQ(PrivateCache(spec, requests, 0).port_cycles(4, 8), 5U);
  spec.ports = 2;
  EXPECT_EQ(PrivateCache(spec, requests, 0).port_cycles(4, 8), 3U);
  spec.banks = 2;
  EXPECT_EQ(PrivateCache(spec, requests, 0).port_cycles(4, 8), 2U);
  EXPECT_EQ(PrivateCache(spec, requests, 0).port_cycles(4, 7), 1U);
}

TEST_F(PrivateCacheTest, SectorsOfALineShareALookUp) {
  CacheSpec spec = small_cache();
  spec.sectors = 4;
  const PrivateCache cache(spec, requests, 0);
  EXPECT_EQ(cache.port_cycles(4, 7), 1U);
  EXPECT_EQ(cache.port_cycles(4, 8), 2U);
}

TEST_F(PrivateCacheTest, LookUpsInOneBankTakeTurns) {
  CacheSpec spec = small_cache();
  spec.banks = 4;
  const PrivateCache cache(spec, requests, 0);
  const auto cycles = [&](const std::vector<std::uint64_t>& lines) {
    return cache.port_cycles(0, static_cast<std::uint32_t>(lines.size()),
                             [&](std::uint32_t i) { return lines[i]; });
  };
  EXPECT_EQ(cycles({0, 5, 10, 15}), 1U);
  EXPECT_EQ(cycles({0, 4, 10, 15}), 2U);
  EXPECT_EQ(cycles({0, 4, 8, 12}), 4U);
}

TEST_F(PrivateCacheTest, WriteThroughPassesTheBytesOfAHitOnAndKeepsTheLineClean) {
  CacheSpec spec = small_cache();
  spec.write.policy = WritePolicy::kThrough;
  PrivateCache cache(spec, requests, 0);
  read(cache, 0);
  fill(cache, 0);
  EXPECT_EQ(modify(cache, 0), Result::kHit);
  EXPECT_EQ(cache.stats().bytes_written, 16U);
  EXPECT_TRUE(cache.take_dirty_lines().empty());
}

TEST_F(PrivateCacheTest, WriteThroughPassesWhatGatheredInAnMshrOnAsOneLine) {
  CacheSpec spec = small_cache();
  spec.write.policy = WritePolicy::kThrough;
  PrivateCache cache(spec, requests, 0);
  modify(cache, 0);
  modify(cache, 0);
  fill(cache, 0);
  EXPECT_EQ(cache.stats().num_writes_through, 1U);
  EXPECT_EQ(cache.stats().bytes_written, 64U);
  EXPECT_EQ(read(cache, 0), Result::kHit);
}

TEST_F(PrivateCacheTest, WithoutAllocationALineIsWrittenOnAndNotKept) {
  CacheSpec spec = small_cache();
  spec.write.allocate = false;
  PrivateCache cache(spec, requests, 0);
  modify(cache, 0);
  fill(cache, 0);
  EXPECT_EQ(cache.stats().num_writebacks, 1U);
  EXPECT_EQ(read(cache, 0), Result::kPending);
}

TEST_F(PrivateCacheTest, FullWriteBufferTakesNoAccessUntilAWriteIsTaken) {
  CacheSpec spec = small_cache();
  spec.write.policy = WritePolicy::kThrough;
  spec.write.buffer = 1;
  PrivateCache cache(spec, requests, 0);
  read(cache, 0);
  fill(cache, 0);
  EXPECT_EQ(modify(cache, 0), Result::kHit);
  EXPECT_FALSE(cache.can_write());
  EXPECT_EQ(modify(cache, 0), Result::kNoMshr);
  EXPECT_EQ(cache.stats().num_write_stalls, 1U);
  EXPECT_EQ(acknowledge(cache), 1U);
  EXPECT_EQ(modify(cache, 0), Result::kHit);
}

TEST_F(PrivateCacheTest, LittlesLawHoldsForMshrs) {
  PrivateCache cache(small_cache(), requests, 0);
  read(cache, 0, 0, 10);
  read(cache, 1, 1, 14);
  fill(cache, 0, 30);
  read(cache, 2, 0, 31);
  fill(cache, 2, 40);
  fill(cache, 1, 50);
  EXPECT_EQ(cache.stats().sum_miss_latency, 20U + 36U + 9U);
  EXPECT_EQ(cache.stats().mshr_occupancy_cycles, cache.stats().sum_miss_latency);
}

}  // namespace
}  // namespace sheaf::test
