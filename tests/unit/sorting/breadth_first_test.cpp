// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/breadth_first.h"

#include <gtest/gtest.h>

#include "rays.h"

namespace sheaf {
namespace {

using IdLists = std::vector<std::vector<std::uint64_t>>;

struct Bench {
  explicit Bench(const char* heuristic) : pool(2) {
    SorterOptions options;
    options.heuristic = HeuristicChoice::parse(heuristic);
    options.num_cells = options.heuristic.natural_cells();
    options.order = RayOrder::kBreadthFirst;
    sorter = make_sorter(options, {}, pool);
  }
  void insert(RayKind kind, std::uint8_t depth, const Vec3& direction = Vec3(1.0F)) {
    Ray ray = ray_of(++id, direction, Vec3(0.0F), kind);
    ray.tag.depth = depth;
    sorter->insert(ray, 0, departures);
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

TEST(BreadthFirst, HoldsAllBackUntilASweep) {
  Bench bench("dir");
  for (int i = 0; i < 10; ++i) bench.insert(RayKind::kReflection, 1);
  EXPECT_TRUE(bench.departures.empty());
  EXPECT_EQ(bench.sorter->num_waiting(), 10U);
  EXPECT_EQ(bench.sorter->stats().max_held, 10U);
}

TEST(BreadthFirst, LetsShadowRaysGoFirstThenReflectionsThenRefractionsOfTheLeastDepth) {
  Bench bench("none");
  bench.insert(RayKind::kReflection, 2);  // 1
  bench.insert(RayKind::kRefraction, 1);  // 2
  bench.insert(RayKind::kReflection, 1);  // 3
  bench.insert(RayKind::kShadow, 2);      // 4
  bench.insert(RayKind::kShadow, 1);      // 5
  EXPECT_EQ(bench.sweep(), (IdLists{{5}}));
  EXPECT_EQ(bench.sweep(), (IdLists{{3}}));
  bench.insert(RayKind::kShadow, 1);  // 6: comes late, and yet before what waits
  EXPECT_EQ(bench.sweep(), (IdLists{{6}}));
  EXPECT_EQ(bench.sweep(), (IdLists{{2}}));
  EXPECT_EQ(bench.sweep(), (IdLists{{4}}));
  EXPECT_EQ(bench.sweep(), (IdLists{{1}}));
  EXPECT_TRUE(bench.sweep().empty());
}

TEST(BreadthFirst, OfNoneFillsPacketsInOrderOfArrival) {
  Bench bench("none");
  for (int i = 0; i < 5; ++i) bench.insert(RayKind::kShadow, 1, Vec3(i % 2 == 0 ? 1.0F : -1.0F));
  EXPECT_EQ(bench.sweep(), (IdLists{{1, 2}, {3, 4}, {5}}));
}

TEST(BreadthFirst, SortsEachWaveByItsHeuristic) {
  Bench bench("dir");
  for (int i = 0; i < 5; ++i) bench.insert(RayKind::kShadow, 1, Vec3(i % 2 == 0 ? 1.0F : -1.0F));
  EXPECT_EQ(bench.sweep(), (IdLists{{1, 3}, {2, 4}, {5}}));
  EXPECT_EQ(bench.sorter->stats().num_insertions, 5U);
  EXPECT_EQ(bench.sorter->stats().num_rays(), 5U);
  EXPECT_EQ(bench.sorter->num_waiting(), 0U);
}

}  // namespace
}  // namespace sheaf
