// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/grid_sorter.h"

#include <gtest/gtest.h>

#include "rays.h"

namespace sheaf {
namespace {

using IdLists = std::vector<std::vector<std::uint64_t>>;

/// A row of voxels along x, numbered 0 to 3, and packets of 2 rays.
struct Bench {
  explicit Bench(std::uint32_t num_cells, std::uint32_t resident = 1, bool by_kind = false)
      : pool(2) {
    SorterOptions options;
    options.heuristic = HeuristicChoice::parse("grid(4)");
    options.num_cells = num_cells;
    options.resident_voxels = resident;
    options.group_by_kind = by_kind;
    sorter = make_sorter(options, {Vec3(0.0F), Vec3(4.0F)}, pool);
  }
  IdLists insert(int voxel, RayKind kind = RayKind::kReflection, Cycles now = 0) {
    departures.clear();
    const Vec3 origin(static_cast<float>(voxel) + 0.5F, 0.5F, 0.5F);
    sorter->insert(ray_of(++id, Vec3(1.0F), origin, kind), now, departures);
    return ids_of(departures);
  }
  IdLists sweep() {
    departures.clear();
    sorter->sweep(Departure::kSweptTile, 0, departures);
    return ids_of(departures);
  }

  PacketPool pool;
  std::unique_ptr<RaySorter> sorter;
  std::vector<RayPacket*> departures;
  std::uint64_t id = 0;
};

TEST(GridSorter, SchedulesTheVoxelWithMostRaysOnceItIsFull) {
  Bench bench(3);  // room for 6 rays
  EXPECT_TRUE(bench.insert(0).empty());
  EXPECT_TRUE(bench.insert(1).empty());
  EXPECT_TRUE(bench.insert(1).empty());
  EXPECT_TRUE(bench.insert(2).empty());
  EXPECT_TRUE(bench.insert(1).empty());
  EXPECT_EQ(bench.insert(2), (IdLists{{2, 3}, {5}}));
  EXPECT_EQ(bench.sorter->num_waiting(), 3U);
  EXPECT_EQ(bench.sorter->stats().num_packets_full, 1U);
  EXPECT_EQ(bench.sorter->stats().num_packets_evicted, 1U);
  EXPECT_EQ(bench.sorter->stats().num_evictions, 1U);
}

TEST(GridSorter, PrefersAVoxelScheduledLastOnceItHasAPacket) {
  Bench bench(3);
  for (const int voxel : {1, 1, 1, 0, 0}) EXPECT_TRUE(bench.insert(voxel).empty());
  EXPECT_EQ(bench.insert(2), (IdLists{{1, 2}, {3}}));  // voxel 1 is resident now
  // Voxel 0 comes to hold three, voxel 1 two.
  for (const int voxel : {0, 1}) EXPECT_TRUE(bench.insert(voxel).empty());
  EXPECT_EQ(bench.insert(1), (IdLists{{8, 9}}));
}

TEST(GridSorter, DoesNotPreferAResidentVoxelWithoutAFullPacket) {
  Bench bench(3);
  for (const int voxel : {1, 1, 1, 0, 0}) bench.insert(voxel);
  bench.insert(2);
  for (const int voxel : {0, 1}) bench.insert(voxel);
  EXPECT_EQ(bench.insert(3), (IdLists{{4, 5}, {7}}));
}

TEST(GridSorter, WithoutResidentVoxelsLooksAtNumbersAlone) {
  Bench bench(3, 0);
  for (const int voxel : {1, 1, 1, 0, 0}) bench.insert(voxel);
  bench.insert(2);
  for (const int voxel : {0, 1}) bench.insert(voxel);
  EXPECT_EQ(bench.insert(1), (IdLists{{4, 5}, {7}}));
}

TEST(GridSorter, SweepsResidentVoxelsFirstThenThoseWithMostRays) {
  Bench bench(3);
  for (const int voxel : {1, 1, 1, 0, 0}) bench.insert(voxel);
  bench.insert(3);
  bench.insert(1);
  EXPECT_EQ(bench.sweep(), (IdLists{{7}, {4, 5}, {6}}));
  EXPECT_EQ(bench.sorter->num_waiting(), 0U);
  EXPECT_EQ(bench.sorter->stats().num_packets_swept_tile, 2U);
  EXPECT_EQ(bench.sorter->stats().num_rays(), bench.sorter->stats().num_insertions);
}

TEST(GridSorter, KeepsKindsApartIfAsked) {
  Bench bench(4, 1, true);
  bench.insert(1);
  bench.insert(1, RayKind::kShadow);
  bench.insert(1);
  EXPECT_EQ(bench.sweep(), (IdLists{{1, 3}, {2}}));
}

TEST(GridSorter, TimesOutTheVoxelsWhoseFirstRayHasWaitedTooLong) {
  Bench bench(4);
  bench.insert(0, RayKind::kReflection, 10);
  bench.insert(1, RayKind::kReflection, 20);
  bench.insert(0, RayKind::kReflection, 30);
  EXPECT_EQ(bench.sorter->oldest_opening(), 10U);
  bench.departures.clear();
  bench.sorter->time_out(15, 40, bench.departures);
  EXPECT_EQ(ids_of(bench.departures), (IdLists{{1, 3}}));
  EXPECT_EQ(bench.sorter->oldest_opening(), 20U);
}

}  // namespace
}  // namespace sheaf
