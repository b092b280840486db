// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/ray5d.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

#include "base/random.h"

namespace sheaf {
namespace {

const Box kBounds{Vec3(-1.0F, 0.0F, 2.0F), Vec3(1.0F, 4.0F, 4.0F)};

Vec3 random_origin(Random& random) {
  return kBounds.lo + kBounds.extent() * Vec3(random.uniform(), random.uniform(), random.uniform());
}
Vec3 random_direction(Random& random) {
  const auto component = [&] { return random.uniform() * 2.0F - 1.0F; };
  return {component(), component(), component()};
}

TEST(VoxelGrid, GivesEveryVoxelItsOwnNumber) {
  const VoxelGrid grid({Vec3(0.0F), Vec3(2.0F, 4.0F, 6.0F)}, 2);
  std::set<std::uint32_t> voxels;
  for (const float x : {0.5F, 1.5F}) {
    for (const float y : {1.0F, 3.0F}) {
      for (const float z : {1.0F, 5.0F}) voxels.insert(grid.voxel({x, y, z}));
    }
  }
  EXPECT_EQ(voxels, (std::set<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(VoxelGrid, TakesWhatLiesOutsideToTheNearestVoxel) {
  const VoxelGrid grid({Vec3(0.0F), Vec3(2.0F)}, 2);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(grid.voxel({-5.0F, -kInfinity, -0.0F}), 0U);
  EXPECT_EQ(grid.voxel({2.0F, 1e30F, kInfinity}), 7U);
  EXPECT_EQ(grid.voxel(Vec3(std::numeric_limits<float>::quiet_NaN())), 0U);
}

TEST(VoxelGrid, OfAFlatBoxHasOneLayer) {
  const VoxelGrid grid({Vec3(0.0F), Vec3(2.0F, 2.0F, 0.0F)}, 4);
  EXPECT_EQ(grid.voxel({0.0F, 0.0F, 0.0F}), grid.voxel({0.0F, 0.0F, 3.0F}));
}

TEST(Ray5d, WithoutLevelsIsTheFaceOfTheDirectionCube) {
  const Ray5dHeuristic heuristic(0, kBounds, 6);
  Random random(71);
  std::set<std::uint32_t> keys;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 direction = random_direction(random);
    const std::uint32_t key = heuristic.key(random_origin(random), direction);
    EXPECT_EQ(key, heuristic.key(random_origin(random), direction * 0.5F));
    keys.insert(key);
  }
  EXPECT_EQ(keys.size(), 6U);
}

TEST(Ray5d, UsesAllItsKeysAndNoOther) {
  const Ray5dHeuristic heuristic(1, kBounds, 192);
  Random random(72);
  std::set<std::uint32_t> keys;
  for (int i = 0; i < 20000; ++i) {
    keys.insert(heuristic.key(random_origin(random), random_direction(random)));
  }
  EXPECT_EQ(keys.size(), 192U);
  EXPECT_EQ(*keys.rbegin(), 191U);
}

// The tree's property: a level more only divides what was together before.
TEST(Ray5d, RaysTogetherAtALevelAreTogetherAtTheLevelAbove) {
  const Ray5dHeuristic coarse(1, kBounds, 1);
  const Ray5dHeuristic fine(2, kBounds, 1);
  Random random(73);
  std::map<std::uint32_t, std::uint32_t> parent;
  for (int i = 0; i < 50000; ++i) {
    const Vec3 origin = random_origin(random);
    const Vec3 direction = random_direction(random);
    const auto [it, added] =
        parent.emplace(fine.key(origin, direction), coarse.key(origin, direction));
    EXPECT_EQ(it->second, coarse.key(origin, direction));
  }
  EXPECT_GT(parent.size(), 5000U);
}

}  // namespace
}  // namespace sheaf
