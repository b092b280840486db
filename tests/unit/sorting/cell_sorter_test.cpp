// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/cell_sorter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "base/random.h"
#include "rays.h"

namespace sheaf {
namespace {

using Ids = std::vector<std::uint64_t>;
using IdLists = std::vector<Ids>;

// Three octants, each a cell of dir.
const Vec3 kA(1.0F, 1.0F, 1.0F);
const Vec3 kB(-1.0F, 1.0F, 1.0F);
const Vec3 kC(1.0F, -1.0F, 1.0F);

/// A ray cache under dir, to which rays are fed by hand.
struct Bench {
  explicit Bench(int packet_size, std::uint32_t num_cells,
                 VictimPolicy victim = VictimPolicy::kFullest)
      : pool(packet_size),
        sorter(make_sorter({HeuristicChoice::parse("dir"), num_cells, victim}, {}, pool)) {}

  /// What leaves because of one more ray; rays are numbered from 1.
  IdLists insert(const Vec3& direction, Cycles now = 0) {
    departures.clear();
    sorter->insert(ray_of(++id, direction), now, departures);
    return ids_of(departures);
  }
  IdLists sweep(Departure why = Departure::kSweptTile, Cycles now = 0) {
    departures.clear();
    sorter->sweep(why, now, departures);
    return ids_of(departures);
  }
  IdLists time_out(Cycles opened_by, Cycles now) {
    departures.clear();
    sorter->time_out(opened_by, now, departures);
    return ids_of(departures);
  }

  PacketPool pool;
  std::unique_ptr<RaySorter> sorter;
  std::vector<RayPacket*> departures;
  std::uint64_t id = 0;
};

TEST(CellSorter, SendsAFullCellOffWithItsRaysInOrderOfArrival) {
  Bench bench(3, 8);
  EXPECT_TRUE(bench.insert(kA).empty());
  EXPECT_TRUE(bench.insert(kB).empty());
  EXPECT_TRUE(bench.insert(kA).empty());
  EXPECT_EQ(bench.insert(kA), (IdLists{{1, 3, 4}}));
  EXPECT_EQ(bench.departures[0]->active, 7U);
  EXPECT_EQ(bench.sorter->num_waiting(), 1U);
  EXPECT_EQ(bench.sorter->stats().num_packets_full, 1U);
  EXPECT_EQ(bench.sorter->stats().num_rays_full, 3U);
}

TEST(CellSorter, CountsAHitOnlyInACellThatIsOpen) {
  Bench bench(2, 8);
  bench.insert(kA);  // miss
  bench.insert(kA);  // hit, and the cell leaves
  bench.insert(kA);  // miss again
  bench.insert(kB);  // miss
  EXPECT_EQ(bench.sorter->stats().num_insertions, 4U);
  EXPECT_EQ(bench.sorter->stats().num_hits, 1U);
  EXPECT_EQ(bench.sorter->stats().num_misses, 3U);
}

TEST(CellSorter, WithOneRayAPacketSendsEveryRayOffAtOnce) {
  Bench bench(1, 1);
  EXPECT_EQ(bench.insert(kA), (IdLists{{1}}));
  EXPECT_EQ(bench.insert(kB), (IdLists{{2}}));
  EXPECT_EQ(bench.sorter->stats().num_evictions, 0U);
}

TEST(CellSorter, EvictsTheFullestCell) {
  Bench bench(4, 2, VictimPolicy::kFullest);
  bench.insert(kA);
  bench.insert(kB);
  bench.insert(kB);
  EXPECT_EQ(bench.insert(kC), (IdLists{{2, 3}}));
  EXPECT_EQ(bench.sorter->stats().num_evictions, 1U);
  EXPECT_EQ(bench.sorter->stats().num_packets_evicted, 1U);
  EXPECT_EQ(bench.sorter->stats().num_rays_evicted, 2U);
}

TEST(CellSorter, OfEquallyFullCellsEvictsTheOneOpenedFirst) {
  Bench bench(4, 2, VictimPolicy::kFullest);
  bench.insert(kA);
  bench.insert(kB);
  EXPECT_EQ(bench.insert(kC), (IdLists{{1}}));
  EXPECT_EQ(bench.insert(kA), (IdLists{{2}}));  // kB is now older than kC, in the other cell
}

TEST(CellSorter, EvictsTheOldestCellHoweverItWasUsed) {
  Bench bench(4, 2, VictimPolicy::kOldest);
  bench.insert(kA);
  bench.insert(kB);
  bench.insert(kB);
  bench.insert(kA);
  EXPECT_EQ(bench.insert(kC), (IdLists{{1, 4}}));
  EXPECT_EQ(bench.insert(kA), (IdLists{{2, 3}}));
}

TEST(CellSorter, EvictsTheLeastRecentlyUsedCell) {
  Bench bench(8, 2, VictimPolicy::kLru);
  bench.insert(kA);
  bench.insert(kB);
  bench.insert(kB);
  bench.insert(kA);
  EXPECT_EQ(bench.insert(kC), (IdLists{{2, 3}}));
  EXPECT_EQ(bench.insert(kB), (IdLists{{1, 4}}));
}

TEST(CellSorter, TimesOutOnlyTheCellsOpenedByThen) {
  Bench bench(4, 8);
  bench.insert(kA, 10);
  bench.insert(kB, 11);
  bench.insert(kC, 12);
  bench.insert(kA, 13);
  EXPECT_EQ(bench.sorter->oldest_opening(), 10U);
  EXPECT_TRUE(bench.time_out(9, 20).empty());
  EXPECT_EQ(bench.time_out(11, 20), (IdLists{{1, 4}, {2}}));
  EXPECT_EQ(bench.sorter->stats().num_packets_timed_out, 2U);
  EXPECT_EQ(bench.sorter->stats().num_rays_timed_out, 3U);
  EXPECT_EQ(bench.sorter->oldest_opening(), 12U);
  EXPECT_EQ(bench.sorter->num_waiting(), 1U);
  bench.sweep();
  EXPECT_EQ(bench.sorter->oldest_opening(), kNever);
}

TEST(CellSorter, IsEmptyAfterASweepWhichIsCountedByItsCause) {
  Bench bench(4, 8);
  for (const Departure why :
       {Departure::kSweptTile, Departure::kSweptFrame, Departure::kSweptStall}) {
    bench.insert(kA);
    bench.insert(kB);
    EXPECT_EQ(bench.sweep(why).size(), 2U);
    EXPECT_EQ(bench.sorter->num_waiting(), 0U);
    EXPECT_TRUE(bench.sweep(why).empty());
  }
  const RayCacheStats& stats = bench.sorter->stats();
  EXPECT_EQ(stats.num_packets_swept_tile, 2U);
  EXPECT_EQ(stats.num_packets_swept_frame, 2U);
  EXPECT_EQ(stats.num_packets_swept_stall, 2U);
  EXPECT_EQ(stats.num_rays_swept_stall, 2U);
  EXPECT_EQ(stats.num_misses, 6U);
}

TEST(CellSorter, RecordsHowFullPacketsLeft) {
  Bench bench(3, 1);
  for (int i = 0; i < 5; ++i) bench.insert(kA);
  bench.insert(kB);  // evicts two rays
  bench.sweep();
  EXPECT_EQ(bench.sorter->fill().bin(3), 1U);
  EXPECT_EQ(bench.sorter->fill().bin(2), 1U);
  EXPECT_EQ(bench.sorter->fill().bin(1), 1U);
  EXPECT_EQ(bench.sorter->fill().num(), 3U);
}

TEST(CellSorter, MeasuresResidenceFromTheFirstRayToTheDeparture) {
  Bench bench(2, 8);
  bench.insert(kA, 100);
  bench.insert(kB, 105);
  bench.insert(kA, 130);
  EXPECT_EQ(bench.sorter->stats().sum_cell_residence, 30U);
  bench.insert(kA, 140);
  bench.sweep(Departure::kSweptFrame, 145);
  EXPECT_EQ(bench.sorter->stats().sum_cell_residence, 30U + 40U + 5U);
  EXPECT_EQ(bench.sorter->stats().max_cell_residence, 40U);
}

TEST(CellSorter, RemembersTheMostRaysAndCellsAtATime) {
  Bench bench(2, 2);
  bench.insert(kA);
  EXPECT_EQ(bench.sorter->stats().max_open_cells, 1U);
  bench.insert(kB);
  EXPECT_EQ(bench.sorter->stats().max_rays, 2U);
  bench.insert(kC);  // evicts before it opens
  EXPECT_EQ(bench.sorter->stats().max_rays, 2U);
  bench.insert(kC);  // the third ray is there before its cell leaves
  EXPECT_EQ(bench.sorter->stats().max_rays, 3U);
  EXPECT_EQ(bench.sorter->stats().max_open_cells, 2U);
  bench.sweep();
  EXPECT_EQ(bench.sorter->stats().max_rays, 3U);
  EXPECT_EQ(bench.sorter->stats().max_open_cells, 2U);
}

struct Case {
  const char* heuristic;
  std::uint32_t num_cells;
  VictimPolicy victim;
  int packet_size;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.heuristic << ", " << c.num_cells << " cells of " << c.packet_size;
}

class AnySorter : public testing::TestWithParam<Case> {};

TEST_P(AnySorter, LosesNoRayAndCountsEachOnce) {
  constexpr std::uint64_t kNumRays = 3000;
  const Case& c = GetParam();
  PacketPool pool(c.packet_size);
  const auto sorter = make_sorter({HeuristicChoice::parse(c.heuristic), c.num_cells, c.victim},
                                  {Vec3(0.0F), Vec3(1.0F)}, pool);
  Random random(7);
  const auto vector = [&](float low) {
    return Vec3(random.uniform() + low, random.uniform() + low, random.uniform() + low);
  };
  Ids seen;
  std::vector<RayPacket*> departures;
  const auto drain = [&] {
    for (RayPacket* packet : departures) {
      const Ids ids = ids_of(*packet);
      EXPECT_EQ(packet->active + 1, std::uint64_t{1} << ids.size()) << "lanes have gaps";
      EXPECT_LE(ids.size(), static_cast<std::size_t>(c.packet_size));
      seen.insert(seen.end(), ids.begin(), ids.end());
      pool.release(packet);
    }
    departures.clear();
  };
  for (std::uint64_t id = 0; id < kNumRays; ++id) {
    sorter->insert(ray_of(id, vector(-0.5F), vector(0.0F)), id, departures);
    drain();
    if (id % 97 == 0) {
      sorter->time_out(id - std::min<Cycles>(id, 50), id, departures);
      drain();
    }
    EXPECT_EQ(seen.size() + sorter->num_waiting(), id + 1);
  }
  sorter->sweep(Departure::kSweptFrame, kNumRays, departures);
  drain();

  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
  EXPECT_EQ(seen.size(), kNumRays);
  EXPECT_EQ(pool.num_out(), 0U);
  const RayCacheStats& stats = sorter->stats();
  EXPECT_EQ(stats.num_insertions, kNumRays);
  EXPECT_EQ(stats.num_hits + stats.num_misses, stats.num_insertions);
  EXPECT_EQ(stats.num_evictions, stats.num_packets_evicted);
  EXPECT_EQ(stats.num_rays_full, stats.num_packets_full * static_cast<unsigned>(c.packet_size));
  EXPECT_EQ(stats.num_rays(), kNumRays);
  EXPECT_EQ(sorter->fill().num(), stats.num_packets());
  EXPECT_EQ(sorter->fill().sum(), kNumRays);
}

INSTANTIATE_TEST_SUITE_P(Cases, AnySorter,
                         testing::Values(Case{"dir", 8, VictimPolicy::kFullest, 16},
                                         Case{"dir", 1, VictimPolicy::kLru, 4},
                                         Case{"mdir(96)", 96, VictimPolicy::kOldest, 16},
                                         Case{"mdir(54)", 7, VictimPolicy::kFullest, 5},
                                         Case{"fastpos", 3, VictimPolicy::kOldest, 63},
                                         Case{"pos(0.02)", 20, VictimPolicy::kLru, 16},
                                         Case{"pos(1e-30)", 4, VictimPolicy::kFullest, 2},
                                         Case{"opos", 1, VictimPolicy::kFullest, 16}));

}  // namespace
}  // namespace sheaf
