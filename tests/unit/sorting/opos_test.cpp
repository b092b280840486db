// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/opos.h"

#include <gtest/gtest.h>

#include "rays.h"

namespace sheaf {
namespace {

using IdLists = std::vector<std::vector<std::uint64_t>>;

const Vec3 kPlus(1.0F, 1.0F, 1.0F);
const Vec3 kMinus(-1.0F, 1.0F, 1.0F);

struct Bench {
  explicit Bench(int packet_size) : pool(packet_size), sorter(false, pool) {}
  void insert(std::uint64_t id, const Vec3& direction, float x, Cycles now = 0) {
    sorter.insert(ray_of(id, direction, {x, 0.0F, 0.0F}), now, departures);
  }
  IdLists sweep(Cycles now = 0) {
    departures.clear();
    sorter.sweep(Departure::kSweptFrame, now, departures);
    return ids_of(departures);
  }
  PacketPool pool;
  OposSorter sorter;
  std::vector<RayPacket*> departures;
};

TEST(Opos, LetsTheFirstRayLeadAndAddsTheNearestOrigins) {
  Bench bench(3);
  bench.insert(1, kPlus, 0.0F);
  bench.insert(2, kPlus, 9.0F);
  bench.insert(3, kPlus, -2.0F);
  bench.insert(4, kPlus, 1.0F);
  bench.insert(5, kPlus, 8.0F);
  EXPECT_EQ(bench.sweep(), (IdLists{{1, 4, 3}, {2, 5}}));
}

TEST(Opos, TakesEquallyNearRaysInOrderOfArrival) {
  Bench bench(3);
  for (std::uint64_t id = 1; id <= 5; ++id) bench.insert(id, kPlus, id == 2 ? 1.0F : 0.0F);
  EXPECT_EQ(bench.sweep(), (IdLists{{1, 3, 4}, {2, 5}}));
}

TEST(Opos, NeverMixesSignConfigurations) {
  Bench bench(4);
  bench.insert(1, kMinus, 0.0F);
  bench.insert(2, kPlus, 0.0F);
  bench.insert(3, {-0.0F, 1.0F, 1.0F}, 5.0F);
  bench.insert(4, {0.0F, 1.0F, 1.0F}, 5.0F);
  EXPECT_EQ(bench.sweep(), (IdLists{{2, 4}, {1, 3}}));
}

TEST(Opos, LetsNothingLeaveBeforeASweepOrForATimeOut) {
  Bench bench(2);
  for (std::uint64_t id = 0; id < 100; ++id) bench.insert(id, kPlus, 0.0F);
  bench.sorter.time_out(1000, 1000, bench.departures);
  EXPECT_TRUE(bench.departures.empty());
  EXPECT_EQ(bench.sorter.num_waiting(), 100U);
  EXPECT_EQ(bench.sorter.oldest_opening(), kNever);
  EXPECT_EQ(bench.sorter.stats().max_rays, 100U);
  EXPECT_EQ(bench.sweep().size(), 50U);
  EXPECT_EQ(bench.sorter.num_waiting(), 0U);
}

TEST(Opos, PutsRaysThatComeLaterIntoTheNextRound) {
  Bench bench(4);
  bench.insert(1, kPlus, 0.0F);
  bench.insert(2, kPlus, 1.0F);
  EXPECT_EQ(bench.sweep(), (IdLists{{1, 2}}));
  bench.insert(3, kPlus, 0.0F);
  EXPECT_EQ(bench.sweep(), (IdLists{{3}}));
  EXPECT_TRUE(bench.sweep().empty());
}

TEST(Opos, CountsAListAsACellAndMeasuresFromAPacketsOldestRay) {
  Bench bench(2);
  bench.insert(1, kPlus, 0.0F, 10);
  bench.insert(2, kPlus, 9.0F, 20);
  bench.insert(3, kPlus, 0.0F, 30);
  bench.insert(4, kMinus, 0.0F, 40);
  EXPECT_EQ(bench.sweep(50), (IdLists{{1, 3}, {2}, {4}}));
  const RayCacheStats& stats = bench.sorter.stats();
  EXPECT_EQ(stats.num_misses, 2U);
  EXPECT_EQ(stats.num_hits, 2U);
  EXPECT_EQ(stats.max_open_cells, 2U);
  EXPECT_EQ(stats.sum_cell_residence, 40U + 30U + 10U);
  EXPECT_EQ(stats.max_cell_residence, 40U);
  EXPECT_EQ(bench.sorter.fill().bin(2), 1U);
  EXPECT_EQ(bench.sorter.fill().bin(1), 2U);
}

}  // namespace
}  // namespace sheaf
