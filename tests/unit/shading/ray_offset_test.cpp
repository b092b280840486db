// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "shading/ray_offset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sheaf {
namespace {

TEST(RayOffset, MovesBy256UlpsAwayFromZeroAndTowardsIt) {
  EXPECT_EQ(offset_coordinate(1.0F, 1.0F), 1.0F + 256.0F * 0x1p-23F);
  EXPECT_EQ(offset_coordinate(1.5F, -1.0F), 1.5F - 256.0F * 0x1p-23F);
  EXPECT_EQ(offset_coordinate(-1.0F, -1.0F), -1.0F - 256.0F * 0x1p-23F);
  EXPECT_EQ(offset_coordinate(-1.5F, 1.0F), -1.5F + 256.0F * 0x1p-23F);
}

TEST(RayOffset, GrowsWithTheCoordinate) {
  EXPECT_EQ(offset_coordinate(1e6F, 1.0F), 1e6F + 256.0F * 0.0625F);
}

TEST(RayOffset, TakesAFixedStepNearZero) {
  EXPECT_EQ(offset_coordinate(0.0F, 1.0F), 0x1p-16F);
  EXPECT_EQ(offset_coordinate(0.03F, -0.5F), 0.03F - 0x1p-17F);
  EXPECT_EQ(offset_coordinate(1.0F / 32.0F, 1.0F), 1.0F / 32.0F + 256.0F * 0x1p-28F);
}

TEST(RayOffset, LeavesCoordinatesAcrossTheNormalAlone) {
  EXPECT_EQ(offset_origin({5.0F, -7.0F, 0.01F}, {1.0F, 0.0F, 0.0F}),
            Vec3(offset_coordinate(5.0F, 1.0F), -7.0F, 0.01F));
}

TEST(RayOffset, HasTheUnitOneInScenesOfOrdinarySizeAndWithoutAny) {
  EXPECT_EQ(offset_unit({Vec3(-0.25F, 0.0F, 0.0F), Vec3(0.0F)}), 1.0F);
  EXPECT_EQ(offset_unit({Vec3(0.0F), Vec3(1e6F)}), 1.0F);
  EXPECT_EQ(offset_unit({}), 1.0F);
}

TEST(RayOffset, ShrinksWithScenesBelowAQuarterOfAUnit) {
  EXPECT_EQ(offset_unit({Vec3(0.0F), Vec3(0.0F, 0.24F, 0.0F)}), 0.125F);
  EXPECT_EQ(offset_unit({Vec3(-3e-6F), Vec3(1e-6F)}), 0x1p-19F);
  EXPECT_GT(offset_unit({Vec3(0.0F), Vec3(0.0F)}), 0.0F);
  const OffsetScale small{.unit = 0x1p-19F};
  EXPECT_EQ(offset_coordinate(0.0F, 1.0F, small), 0x1p-35F);
  EXPECT_EQ(offset_coordinate(0x1p-24F, 1.0F, small), 0x1p-24F + 256.0F * 0x1p-47F);
}

TEST(RayOffset, StepsAtLeastAMillionthOfTrianglesLargerThan64Units) {
  EXPECT_EQ(least_offset(64.0F), 0.0F);
  const OffsetScale large{.least = least_offset(0x1p20F)};
  EXPECT_EQ(large.least, 1.0F);
  EXPECT_EQ(offset_coordinate(0.0F, 0.5F, large), 0.5F);
  EXPECT_EQ(offset_coordinate(100.0F, -0.5F, large), 99.5F);
  EXPECT_EQ(offset_coordinate(1e6F, 1.0F, large), offset_coordinate(1e6F, 1.0F));
}

TEST(RayOffset, StepsFourUlpsAlongTheNormalInScenesFartherThan256TimesTheirExtent) {
  EXPECT_EQ(far_offset({Vec3(1024.0F), Vec3(1028.0F)}), 4.0F * 0x1p-13F);
  EXPECT_EQ(far_offset({Vec3(-1028.0F), Vec3(-1024.0F)}), 4.0F * 0x1p-13F);
  EXPECT_EQ(far_offset({Vec3(1020.0F), Vec3(1024.0F)}), 0.0F);  // exactly 256 times
  EXPECT_EQ(far_offset({Vec3(0.0F), Vec3(1e6F)}), 0.0F);
  EXPECT_EQ(far_offset({}), 0.0F);
  const OffsetScale far{.unit = 1.0F, .least = 0.0F, .far = 0.25F};
  EXPECT_EQ(offset_coordinate(1e6F, 1.0F, far), 1e6F + 0.25F);
  EXPECT_EQ(offset_coordinate(0.0F, -0.5F, far), -0.125F);
}

TEST(RayOffset, NeverLeavesTheFloats) {
  const float max = std::numeric_limits<float>::max();
  EXPECT_TRUE(std::isfinite(offset_coordinate(max, 1.0F)));
  EXPECT_TRUE(std::isfinite(offset_coordinate(-max, -1.0F)));
  EXPECT_LT(offset_coordinate(max, -1.0F), max);
}

}  // namespace
}  // namespace sheaf
