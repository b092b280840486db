// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "traversal/packet_pool.h"

#include <gtest/gtest.h>

#include "base/object_pool.h"
#include "rays.h"

namespace sheaf {
namespace {

TEST(PacketPool, GrowsOnlyToTheMostPacketsOutAtATime) {
  PacketPool pool(16);
  RayPacket* first = pool.acquire();
  RayPacket* second = pool.acquire();
  EXPECT_NE(first, second);
  EXPECT_EQ(pool.num_out(), 2U);
  for (int i = 0; i < 10; ++i) {
    pool.release(first);
    first = pool.acquire();
  }
  EXPECT_EQ(pool.num_made(), 2U);
  pool.release(first);
  pool.release(second);
  EXPECT_EQ(pool.num_out(), 0U);
}

TEST(PacketPool, HandsOutAUsedPacketEmptyAndOfTheMachinesSize) {
  PacketPool pool(5);
  RayPacket* packet = pool.acquire();
  packet->put(3, ray_of(1, Vec3(1.0F), Vec3(0.0F), RayKind::kShadow));
  packet->size = 64;
  pool.release(packet);
  ASSERT_EQ(pool.acquire(), packet);
  EXPECT_EQ(packet->size, 5);
  EXPECT_EQ(packet->active, 0U);
  EXPECT_EQ(packet->any_hit, 0U);
}

TEST(ObjectPool, ReusesWhatCameBackAndCountsWhatIsOut) {
  ObjectPool<int> pool;
  int* first = pool.acquire();
  int* second = pool.acquire();
  EXPECT_NE(first, second);
  EXPECT_EQ(pool.num_out(), 2U);
  pool.release(first);
  EXPECT_EQ(pool.num_out(), 1U);
  EXPECT_EQ(pool.acquire(), first);
  EXPECT_EQ(pool.num_out(), 2U);
}

}  // namespace
}  // namespace sheaf
