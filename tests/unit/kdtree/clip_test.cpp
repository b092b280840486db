// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/clip.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace sheaf::test {
namespace {

const Box kUnitCell{Vec3(0.0F), Vec3(1.0F)};

TEST(SplitTriangle, PartsHaveTightBoxes) {
  // The hypotenuse runs from (0, 1) to (1, 0): at x = 0.25 it is at y = 0.75.
  const SplitParts parts =
      split_triangle({Vec3(0.0F, 0.0F, 0.5F), Vec3(1.0F, 0.0F, 0.5F), Vec3(0.0F, 1.0F, 0.5F)},
                     kUnitCell, 0, 0.25F);
  ASSERT_TRUE(parts.in_left);
  ASSERT_TRUE(parts.in_right);
  EXPECT_EQ(parts.left, (Box{Vec3(0.0F, 0.0F, 0.5F), Vec3(0.25F, 1.0F, 0.5F)}));
  EXPECT_EQ(parts.right.lo, Vec3(0.25F, 0.0F, 0.5F));
  EXPECT_EQ(parts.right.hi.x, 1.0F);
  EXPECT_GE(parts.right.hi.y, 0.75F);
  EXPECT_LE(parts.right.hi.y, 0.7500002F);
  EXPECT_EQ(parts.right.hi.z, 0.5F);
}

TEST(SplitTriangle, TriangleThatOnlyItsBoxBringsIntoAHalfIsNotThere) {
  // Crosses the cell's upper left corner; its box reaches x = 1, the clipped part only x = 0.5.
  const SplitParts parts =
      split_triangle({Vec3(0.0F, 0.5F, 0.5F), Vec3(0.0F, 1.5F, 0.5F), Vec3(1.0F, 1.5F, 0.5F)},
                     kUnitCell, 0, 0.75F);
  EXPECT_TRUE(parts.in_left);
  EXPECT_FALSE(parts.in_right);
}

TEST(SplitTriangle, PartThatOnlyTouchesThePlaneGoesToTheOtherSide) {
  const std::array<Vec3, 3> left{Vec3(0.0F, 0.0F, 0.0F), Vec3(0.5F, 0.0F, 0.0F),
                                 Vec3(0.0F, 0.5F, 0.5F)};
  const SplitParts parts = split_triangle(left, kUnitCell, 0, 0.5F);
  EXPECT_TRUE(parts.in_left);
  EXPECT_FALSE(parts.in_right);
}

// Points of a triangle inside a half cell must lie in that half's box: compared in double
// precision, with no tolerance beyond the rounding of the sample itself.
TEST(SplitTriangle, BoxesHoldEveryPointOfTheirPart) {
  Random random(5);
  const auto point = [&](float scale, float offset) {
    const float x = random.uniform();
    const float y = random.uniform();
    return scale * (Vec3(x, y, random.uniform()) * 2.0F - 0.5F) + offset;
  };
  for (int round = 0; round < 3000; ++round) {
    const float scale = round % 3 == 0 ? 1e-4F : 1.0F;
    const float offset = round % 2 == 0 ? 0.0F : 100.0F;
    const std::array<Vec3, 3> corners{point(scale, offset), point(scale, offset),
                                      point(scale, offset)};
    const Box cell{Vec3(offset), Vec3(scale + offset)};
    const int axis = round % 3;
    const float plane = offset + scale * (0.1F + 0.8F * random.uniform());
    const SplitParts parts = split_triangle(corners, cell, axis, plane);
    for (int sample = 0; sample < 30; ++sample) {
      double u = random.uniform();
      double v = random.uniform();
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const Vec3d p = Vec3d(corners[0]) + u * (Vec3d(corners[1]) - Vec3d(corners[0])) +
                      v * (Vec3d(corners[2]) - Vec3d(corners[0]));
      if (glm::any(glm::lessThan(p, Vec3d(cell.lo))) ||
          glm::any(glm::greaterThan(p, Vec3d(cell.hi)))) {
        continue;
      }
      const bool is_left = p[axis] < plane;
      ASSERT_TRUE(is_left ? parts.in_left : parts.in_right);
      const Box& box = is_left ? parts.left : parts.right;
      const Vec3d tolerance = 1e-15 * glm::abs(p);
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(p + tolerance, Vec3d(box.lo))));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(p - tolerance, Vec3d(box.hi))));
    }
  }
}

TEST(SplitTriangle, BoxesStayInsideTheirHalves) {
  Random random(6);
  for (int round = 0; round < 1000; ++round) {
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      for (int k = 0; k < 3; ++k) corner[k] = 2.0F * random.uniform() - 0.5F;
    }
    const float plane = 0.1F + 0.8F * random.uniform();
    const SplitParts parts = split_triangle(corners, kUnitCell, 1, plane);
    if (parts.in_left) {
      EXPECT_LE(parts.left.hi.y, plane);
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(parts.left.lo, kUnitCell.lo)));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(parts.left.lo, parts.left.hi)));
    }
    if (parts.in_right) {
      EXPECT_GE(parts.right.lo.y, plane);
      EXPECT_TRUE(glm::all(glm::lessThanEqual(parts.right.hi, kUnitCell.hi)));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(parts.right.lo, parts.right.hi)));
    }
  }
}

TEST(SplitTriangle, PlanarTrianglesStayPlanar) {
  // Interpolation must not give an axis-aligned wall a thickness.
  const float height = 0.3F;
  const SplitParts parts = split_triangle(
      {Vec3(-0.7F, 0.1F, height), Vec3(1.3F, -0.3F, height), Vec3(0.4F, 1.7F, height)}, kUnitCell,
      0, 0.35F);
  ASSERT_TRUE(parts.in_left && parts.in_right);
  for (const Box& box : {parts.left, parts.right}) {
    EXPECT_EQ(box.lo.z, height);
    EXPECT_EQ(box.hi.z, height);
  }
}

}  // namespace
}  // namespace sheaf::test
