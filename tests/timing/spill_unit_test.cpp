// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/spill_unit.h"

#include <gtest/gtest.h>

#include <deque>
#include <map>

#include "timing/bench.h"

namespace sheaf::test {
namespace {

constexpr Address kBase = 0x1000;
constexpr Cycles kMemory = 20;  // from a read's arrival at the memory to its line on the link back

/// Shaders before the unit, a ray cache behind it that reads when a test says so, and a memory.
struct SpillTest : testing::Test {
  ClockDomain domain{"domain", one_nanosecond()};
  Actor shader{domain};
  Actor ray_cache{domain};
  Actor memory{domain};
  TimedChannel<SpawnBundle*> in{"in", {.capacity = 8, .latency = 1}};
  TimedChannel<SpawnBundle*> out{"out", {.capacity = 1, .latency = 1}};
  TimedChannel<LineRequest> requests{
      "requests", {.capacity = TimedChannel<LineRequest>::kUnbounded, .latency = 1, .interval = 0}};
  TimedChannel<LineResponse> lines{
      "lines", {.capacity = TimedChannel<LineResponse>::kUnbounded, .latency = 1, .interval = 1}};
  SpillUnit unit;
  std::deque<SpawnBundle> bundles;
  std::vector<std::pair<Cycles, LineRequest>> asked;  ///< when sent
  std::vector<std::pair<Cycles, std::size_t>> left;   ///< when read, which bundle

  explicit SpillTest(std::uint32_t queue = 16)
      : unit("spill", {.queue = queue, .line = 64, .base = kBase, .requester = 3}, requests,
             domain) {
    unit.in_bundles(in);
    unit.out_bundles(out);
    unit.in_lines(lines);
    in.add_producer(shader.inbox());
    out.set_consumer(ray_cache.inbox());
    requests.set_consumer(memory.inbox());
    lines.add_producer(memory.inbox());
    memory.always([this](Cycles now) {
      while (requests.has_arrived(now)) {
        const LineRequest request = requests.read(now);
        asked.emplace_back(now - 1, request);
        if (!request.write) lines.write_ahead({request.address}, now + kMemory);
      }
      if (requests.next_arrival() != kNever) memory.inbox().nudge(requests.next_arrival());
    });
  }
  void send_at(Cycles time, std::size_t rays) {
    bundles.emplace_back();
    SpawnBundle* const bundle = &bundles.back();
    bundle->rays.resize(rays);
    shader.at(time, [=, this] { in.nb_write(bundle, time); });
  }
  /// Reads a bundle at each of these times if one is there.
  void read_at(const std::vector<Cycles>& times) {
    for (const Cycles time : times) {
      ray_cache.at(time, [=, this] {
        if (!out.has_arrived(time)) return;
        const SpawnBundle* const bundle = out.read(time);
        for (std::size_t i = 0; i < bundles.size(); ++i) {
          if (&bundles[i] == bundle) left.emplace_back(time, i);
        }
      });
    }
  }
  void read_from(Cycles begin, Cycles end) {
    std::vector<Cycles> times;
    for (Cycles t = begin; t < end; ++t) times.push_back(t);
    read_at(times);
  }
};

TEST_F(SpillTest, BundleThatFitsPassesACycleAfterItsArrival) {
  send_at(0, 16);
  read_from(0, 10);
  sc_core::sc_start();
  // Arrives at 1, is queued then, leaves at 2 and arrives at 3.
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].first, 3U);
  EXPECT_TRUE(asked.empty());
}

TEST_F(SpillTest, BundlesThatFitTogetherAreAllKept) {
  for (const Cycles t : {0, 0, 0}) send_at(t, 8);  // one on the link to the ray cache, two queued
  read_from(100, 200);
  sc_core::sc_start();
  EXPECT_EQ(left.size(), 3U);
  EXPECT_EQ(unit.stats().num_rays_kept, 24U);
}

TEST_F(SpillTest, RayTooManyGoesToMemoryALineACycle) {
  send_at(0, 1);  // leaves the queue for the link
  send_at(1, 9);
  send_at(2, 8);  // 9 + 8 rays are one too many: 384 bytes, 6 lines
  read_from(100, 300);
  sc_core::sc_start();
  ASSERT_EQ(unit.stats().num_rays_spilled, 8U);
  ASSERT_EQ(asked.size(), 12U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_TRUE(asked[i].second.write);
    EXPECT_EQ(asked[i].first, 4U + i);  // taken at 3
    EXPECT_EQ(asked[i].second.address, kBase + 64 * i);
    EXPECT_EQ(asked[i].second.kind, DataKind::kSpilledRay);
    EXPECT_EQ(asked[i].second.requester, 3U);
  }
}

TEST_F(SpillTest, ComesBackWhenItsPlaceIsFree) {
  send_at(0, 1);
  send_at(1, 9);
  send_at(2, 8);
  read_from(100, 300);
  sc_core::sc_start();
  // The first is read at 100; its credit is back at 101, when the second leaves the queue and its
  // place is taken by the third, whose lines are asked for from then on.
  ASSERT_EQ(asked.size(), 12U);
  for (std::size_t i = 6; i < 12; ++i) {
    EXPECT_FALSE(asked[i].second.write);
    EXPECT_EQ(asked[i].first, 101U + i - 6);
    EXPECT_EQ(asked[i].second.address, kBase + 64 * (i - 6));
  }
  ASSERT_EQ(left.size(), 3U);
  const Cycles last_line = 101 + 5 + 1 + kMemory + 1;
  EXPECT_EQ(left[2].first, last_line + 1);
  EXPECT_EQ(unit.stats().max_spill_latency, last_line - 3);
}

TEST_F(SpillTest, NothingOvertakesASpilledBundle) {
  send_at(0, 1);
  send_at(1, 16);
  send_at(2, 8);                                // spilled
  for (const Cycles t : {3, 4}) send_at(t, 1);  // would fit when 16 have left
  read_from(50, 400);
  sc_core::sc_start();
  ASSERT_EQ(left.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(left[i].second, i);
  EXPECT_EQ(unit.stats().num_rays_spilled, 10U);
  EXPECT_EQ(unit.stats().num_rays_returned, 10U);
}

TEST_F(SpillTest, BundleLargerThanTheQueuePassesWhenItIsEmpty) {
  send_at(0, 40);
  send_at(0, 40);
  read_from(50, 400);
  sc_core::sc_start();
  EXPECT_EQ(left.size(), 2U);
  EXPECT_EQ(unit.stats().num_rays_spilled, 0U);
}

TEST_F(SpillTest, LittlesLawHoldsForItsQueue) {
  for (Cycles t = 0; t < 40; ++t) send_at(t * 3, 1 + t % 12);
  std::vector<Cycles> times;
  for (Cycles t = 0; t < 4000; t += 11) times.push_back(t);
  read_at(times);
  sc_core::sc_start();
  const SpillStats& stats = unit.stats();
  EXPECT_EQ(left.size(), 40U);
  EXPECT_GT(stats.num_rays_spilled, 50U);
  EXPECT_GT(stats.num_rays_kept, 10U);
  EXPECT_EQ(stats.num_rays, stats.num_rays_kept + stats.num_rays_spilled);
  EXPECT_EQ(stats.queue_occupancy_cycles, stats.sum_queue_residence);
  EXPECT_LE(stats.max_rays_queued, 16U);
  EXPECT_TRUE(unit.is_idle());
}

}  // namespace
}  // namespace sheaf::test
