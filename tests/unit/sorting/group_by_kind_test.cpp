// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "base/random.h"
#include "rays.h"
#include "sorting/kind_group.h"
#include "sorting/ray_sorter.h"

namespace sheaf {
namespace {

class GroupByKind : public testing::TestWithParam<const char*> {};

TEST_P(GroupByKind, NeverMixesKindsInAPacketAndLosesNoRay) {
  for (const std::uint32_t num_cells : {1U, 3U, 64U}) {
    PacketPool pool(4);
    SorterOptions options;
    options.heuristic = HeuristicChoice::parse(GetParam());
    options.num_cells = num_cells;
    options.group_by_kind = true;
    const auto sorter = make_sorter(options, {Vec3(-1.0F), Vec3(1.0F)}, pool);
    Random random(81);
    const auto any = [&] { return random.uniform() * 2.0F - 1.0F; };
    std::vector<RayPacket*> departures;
    constexpr std::uint64_t kRays = 500;
    for (std::uint64_t id = 0; id < kRays; ++id) {
      const auto kind = static_cast<RayKind>(1 + random.below(3));
      sorter->insert(ray_of(id, {any(), any(), any()}, {any(), any(), any()}, kind), 0, departures);
    }
    sorter->sweep(Departure::kSweptFrame, 0, departures);
    std::set<std::uint64_t> seen;
    for (const RayPacket* packet : departures) {
      std::set<std::size_t> groups;
      for (int lane = 0; lane < packet->size; ++lane) {
        if ((packet->active >> lane & 1U) == 0) continue;
        groups.insert(kind_group(packet->get(lane).tag.kind));
        seen.insert(packet->get(lane).tag.id);
      }
      EXPECT_EQ(groups.size(), 1U);
    }
    EXPECT_EQ(seen.size(), kRays);
    EXPECT_EQ(sorter->stats().num_hits + sorter->stats().num_misses, kRays);
    EXPECT_EQ(sorter->stats().num_evictions, sorter->stats().num_packets_evicted);
  }
}

INSTANTIATE_TEST_SUITE_P(Heuristics, GroupByKind,
                         testing::Values("dir", "mdir(24)", "fastpos", "pos(0.5)", "opos",
                                         "ray5d(1)", "grid(2)"));

}  // namespace
}  // namespace sheaf
