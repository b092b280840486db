// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rays.h"
#include "sorting/spawn_bundle.h"

namespace sheaf {
namespace {

TEST(SplitByKind, MakesOnePacketOfEachGroupWithEveryRayInItsParentsLane) {
  const Vec3 z(0.0F, 0.0F, 1.0F);
  SpawnBundle bundle;
  bundle.begin_group();
  bundle.add(ray_of(1, z), 0);
  bundle.add(ray_of(2, z), 7);
  bundle.begin_group();  // no refractions
  bundle.begin_group();
  bundle.add(ray_of(3, z, z, RayKind::kShadow), 6);
  bundle.add(ray_of(4, z, z, RayKind::kShadow), 7);
  bundle.begin_group();
  PacketPool pool(8);
  std::vector<RayPacket*> packets;
  split_by_kind(bundle, pool, packets);

  ASSERT_EQ(packets.size(), 2U);
  EXPECT_EQ(packets[0]->active, 0x81U);
  EXPECT_EQ(packets[0]->any_hit, 0U);
  EXPECT_EQ(packets[0]->size, 8);
  EXPECT_EQ(ids_of(*packets[0]), (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(packets[1]->active, 0xC0U);
  EXPECT_EQ(packets[1]->any_hit, 0xC0U);
  EXPECT_EQ(ids_of(*packets[1]), (std::vector<std::uint64_t>{3, 4}));
  EXPECT_EQ(packets[1]->get(7).tag.kind, RayKind::kShadow);
}

TEST(SplitByKind, MakesNothingOfABundleWithoutRays) {
  SpawnBundle bundle;
  bundle.begin_group();
  bundle.add(ray_of(1, Vec3(1.0F)), 0);
  bundle.clear();
  bundle.begin_group();
  PacketPool pool(8);
  std::vector<RayPacket*> packets;
  split_by_kind(bundle, pool, packets);
  EXPECT_TRUE(packets.empty());
  EXPECT_EQ(pool.num_out(), 0U);
}

}  // namespace
}  // namespace sheaf
