// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/compare.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace sheaf {
namespace {

TEST(CompareImages, FindsNoDifferenceBetweenEqualImages) {
  const std::vector<Vec3> image{{1.0F, 2.0F, 3.0F}, {0.0F, 1e30F, 1e-30F}};
  const ImageDifference d = compare_images(image, image);
  EXPECT_EQ(d.rmse, 0.0);
  EXPECT_EQ(d.rel_mse, 0.0);
  EXPECT_EQ(d.max_abs, 0.0);
}

TEST(CompareImages, MatchesItsFormulas) {
  const std::vector<Vec3> image{{1.0F, 2.0F, 3.0F}, {0.0F, 0.5F, 0.0F}};
  const std::vector<Vec3> reference{{1.0F, 4.0F, 3.0F}, {0.0F, 0.0F, 0.0F}};
  const ImageDifference d = compare_images(image, reference);
  EXPECT_DOUBLE_EQ(d.rmse, std::sqrt((4.0 + 0.25) / 6.0));
  EXPECT_DOUBLE_EQ(d.rel_mse, (4.0 / 16.01 + 0.25 / 0.01) / 6.0);
  EXPECT_DOUBLE_EQ(d.max_abs, 2.0);
  EXPECT_EQ(d.worst_pixel, 0U);
}

TEST(CompareImages, DoesNotHideANan) {
  std::vector<Vec3> image(3, Vec3(0.0F));
  const std::vector<Vec3> reference(3, Vec3(0.0F));
  image[1].y = std::numeric_limits<float>::quiet_NaN();
  image[2].x = 5.0F;
  const ImageDifference d = compare_images(image, reference);
  EXPECT_TRUE(std::isnan(d.rmse));
  EXPECT_TRUE(std::isnan(d.rel_mse));
  EXPECT_TRUE(std::isnan(d.max_abs));
  EXPECT_EQ(d.worst_pixel, 1U);
}

TEST(CompareImages, RefusesImagesOfDifferentSize) {
  const std::vector<Vec3> one(1);
  const std::vector<Vec3> two(2);
  EXPECT_THROW((void)compare_images(one, two), std::logic_error);
  EXPECT_THROW((void)compare_images({}, {}), std::logic_error);
}

}  // namespace
}  // namespace sheaf
