// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/random.h"
#include "sorting/dir.h"
#include "sorting/fastpos.h"
#include "sorting/mdir.h"

namespace sheaf {
namespace {

const Vec3 kAnywhere(0.0F);

Vec3 random_direction(Random& random) {
  const auto component = [&] { return random.uniform() * 2.0F - 1.0F; };
  return {component(), component(), component()};
}

/// All directions whose components are of a few special values, zeros of both signs among them.
std::vector<Vec3> special_directions() {
  const float values[] = {0.0F, -0.0F, 1e-42F, -1e-42F, 0.5F, -0.5F, 1.0F, -1.0F};
  std::vector<Vec3> all;
  for (const float x : values) {
    for (const float y : values) {
      for (const float z : values) {
        if (x != 0.0F || y != 0.0F || z != 0.0F) all.emplace_back(x, y, z);
      }
    }
  }
  return all;
}

TEST(SignCode, TakesTheSignOfAZeroFromItsSignBit) {
  EXPECT_EQ(sign_code({0.0F, 0.0F, 0.0F}), 0U);
  EXPECT_EQ(sign_code({-0.0F, 0.0F, 0.0F}), 1U);
  EXPECT_EQ(sign_code({0.0F, -0.0F, 0.0F}), 2U);
  EXPECT_EQ(sign_code({0.0F, 0.0F, -0.0F}), 4U);
  EXPECT_EQ(sign_code({-1.0F, 1.0F, -1e-42F}), 5U);
}

TEST(Dir, GivesEveryOctantOfDirectionsItsOwnCell) {
  const DirHeuristic dir(8);
  std::map<std::uint32_t, std::uint32_t> key_of_code;
  for (const Vec3& direction : special_directions()) {
    const std::uint32_t key = dir.key(kAnywhere, direction);
    EXPECT_LT(key, 8U);
    EXPECT_EQ(key_of_code.emplace(sign_code(direction), key).first->second, key);
  }
  std::set<std::uint32_t> keys;
  for (const auto& [code, key] : key_of_code) keys.insert(key);
  EXPECT_EQ(keys.size(), 8U);
}

TEST(Keyed, FindsACellOnlyWhileItIsOpen) {
  DirHeuristic dir(3);
  const Vec3 up(0.1F, 1.0F, 0.1F);
  const Vec3 down(0.1F, -1.0F, 0.1F);
  EXPECT_EQ(dir.find(kAnywhere, up), kNoCell);
  dir.open(2, kAnywhere, up);
  EXPECT_EQ(dir.find(kAnywhere, up), 2U);
  EXPECT_EQ(dir.find(kAnywhere, down), kNoCell);
  dir.close(2);
  EXPECT_EQ(dir.find(kAnywhere, up), kNoCell);
}

class MdirSide : public testing::TestWithParam<std::uint32_t> {};

TEST_P(MdirSide, ReachesEveryCellAndNoOther) {
  const std::uint32_t k = GetParam();
  const MdirHeuristic mdir(k, 1);
  std::set<std::uint32_t> keys;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float longest : {2.0F, -2.0F}) {
      for (std::uint32_t i = 0; i < k * k; ++i) {
        const auto middle = [&](std::uint32_t cell) {
          return (static_cast<float>(2 * cell + 1) / static_cast<float>(k) - 1.0F) * 2.0F;
        };
        Vec3 direction;
        direction[axis] = longest;
        direction[(axis + 1) % 3] = middle(i % k);
        direction[(axis + 2) % 3] = middle(i / k);
        keys.insert(mdir.key(kAnywhere, direction));
      }
    }
  }
  EXPECT_EQ(keys.size(), 6U * k * k);
  EXPECT_EQ(*keys.rbegin(), 6U * k * k - 1);
  for (const Vec3& direction : special_directions()) {
    EXPECT_LT(mdir.key(kAnywhere, direction), 6U * k * k);
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, MdirSide, testing::Values(1U, 2U, 3U, 4U, 5U, 6U, 16U));

TEST(Mdir, WithAnEvenSideNeverMixesSignConfigurationsInACell) {
  for (const std::uint32_t k : {2U, 4U, 6U, 16U}) {
    const MdirHeuristic mdir(k, 1);
    std::map<std::uint32_t, std::uint32_t> code_of_key;
    const auto check = [&](const Vec3& direction) {
      const auto code = sign_code(direction);
      const auto key = mdir.key(kAnywhere, direction);
      EXPECT_EQ(code_of_key.emplace(key, code).first->second, code) << "k " << k;
    };
    Random random(k);
    for (int i = 0; i < 20000; ++i) check(random_direction(random));
    for (const Vec3& direction : special_directions()) check(direction);
  }
}

TEST(Mdir, DividesAFaceEquallyInFaceCoordinates) {
  // k = 4 on the face of +z: boundaries at x/z = -0.5, 0 and 0.5, whatever the length.
  const MdirHeuristic mdir(4, 96);
  const auto key = [&](float x) { return mdir.key(kAnywhere, Vec3(x, 0.1F, 1.0F) * 3.0F); };
  EXPECT_EQ(key(-0.99F), key(-0.51F));
  EXPECT_NE(key(-0.51F), key(-0.49F));
  EXPECT_EQ(key(-0.49F), key(-0.01F));
  EXPECT_NE(key(-0.01F), key(0.01F));
  EXPECT_EQ(key(0.01F), key(0.49F));
  EXPECT_NE(key(0.49F), key(0.51F));
  EXPECT_EQ(key(0.51F), key(0.99F));
}

TEST(Fastpos, GivesEveryOctantOfTheBoundsItsOwnCell) {
  const Box bounds{{-1.0F, 10.0F, 0.0F}, {3.0F, 30.0F, 2.0F}};  // centre (1, 20, 1)
  const FastposHeuristic fastpos(bounds, 8);
  std::set<std::uint32_t> keys;
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const auto key_at = [&](float share) {  // of the way from the centre to the octant's corner
      Vec3 p(1.0F, 20.0F, 1.0F);
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3& corner = (octant >> axis & 1U) != 0 ? bounds.lo : bounds.hi;
        p[axis] += (corner[axis] - p[axis]) * share;
      }
      return fastpos.key(p, {1.0F, 0.0F, 0.0F});
    };
    keys.insert(key_at(1.0F));
    EXPECT_EQ(key_at(0.01F), key_at(1.0F));
    EXPECT_EQ(key_at(5.0F), key_at(1.0F)) << "outside of the bounds";
  }
  EXPECT_EQ(keys.size(), 8U);
  EXPECT_LT(*keys.rbegin(), 8U);
}

}  // namespace
}  // namespace sheaf
