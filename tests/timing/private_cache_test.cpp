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
  cache.modify(0, DataKind::kPixel, 0, 0);
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

}  // namespace
}  // namespace sheaf::test
