// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "shading/texture_lookup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sheaf {
namespace {

using Wrap = Texture::Wrap;

/// One row of grey texels whose encoded values are 10, 20, 30, …
Texture row_of_greys(std::uint32_t width, Wrap wrap, bool nearest) {
  Texture t;
  t.width = width;
  t.height = 1;
  t.wrap_u = wrap;
  t.wrap_v = Wrap::kClampToEdge;
  t.nearest = nearest;
  t.rgba.resize(std::size_t{4} * width);
  for (std::size_t i = 0; i < t.rgba.size(); ++i) {
    t.rgba[i] = static_cast<std::uint8_t>(i % 4 == 3 ? 255 : 10 * (i / 4 + 1));
  }
  return t;
}

std::uint32_t nearest_column(Wrap wrap, float u) {
  return sample_texture(row_of_greys(4, wrap, true), {u, 0.5F}).texels[0].x;
}

TEST(SrgbToLinear, MatchesTheStandard) {
  EXPECT_EQ(srgb_to_linear(0), 0.0F);
  EXPECT_EQ(srgb_to_linear(255), 1.0F);
  EXPECT_FLOAT_EQ(srgb_to_linear(10), static_cast<float>(10.0 / 255.0 / 12.92));
  EXPECT_NEAR(srgb_to_linear(188), 0.5029F, 5e-5F);
  for (int i = 1; i < 256; ++i) {
    EXPECT_GT(srgb_to_linear(static_cast<std::uint8_t>(i)),
              srgb_to_linear(static_cast<std::uint8_t>(i - 1)));
  }
}

TEST(SampleTexture, TakesTheNearestTexel) {
  EXPECT_EQ(nearest_column(Wrap::kRepeat, 0.0F), 0U);
  EXPECT_EQ(nearest_column(Wrap::kRepeat, 0.249F), 0U);
  EXPECT_EQ(nearest_column(Wrap::kRepeat, 0.25F), 1U);
  EXPECT_EQ(nearest_column(Wrap::kRepeat, 0.999F), 3U);
}

TEST(SampleTexture, Repeats) {
  EXPECT_EQ(nearest_column(Wrap::kRepeat, 1.0F), 0U);
  EXPECT_EQ(nearest_column(Wrap::kRepeat, 7.3F), 1U);
  EXPECT_EQ(nearest_column(Wrap::kRepeat, -0.1F), 3U);
  EXPECT_EQ(nearest_column(Wrap::kRepeat, -3.4F), 2U);
}

TEST(SampleTexture, RepeatsMirrored) {
  EXPECT_EQ(nearest_column(Wrap::kMirroredRepeat, 1.1F), 3U);
  EXPECT_EQ(nearest_column(Wrap::kMirroredRepeat, 1.9F), 0U);
  EXPECT_EQ(nearest_column(Wrap::kMirroredRepeat, 2.1F), 0U);
  EXPECT_EQ(nearest_column(Wrap::kMirroredRepeat, -0.1F), 0U);
  EXPECT_EQ(nearest_column(Wrap::kMirroredRepeat, -0.9F), 3U);
}

TEST(SampleTexture, ClampsToTheEdge) {
  EXPECT_EQ(nearest_column(Wrap::kClampToEdge, 1.0F), 3U);
  EXPECT_EQ(nearest_column(Wrap::kClampToEdge, 1e30F), 3U);
  EXPECT_EQ(nearest_column(Wrap::kClampToEdge, -5.0F), 0U);
}

TEST(SampleTexture, TakesATexelsCentreUnchanged) {
  const auto sample = sample_texture(row_of_greys(4, Wrap::kRepeat, false), {0.375F, 0.5F});
  EXPECT_EQ(sample.color.x, srgb_to_linear(20));
  EXPECT_EQ(sample.num_texels, 4);
}

TEST(SampleTexture, BlendsLinearValuesBetweenCentres) {
  const auto sample = sample_texture(row_of_greys(4, Wrap::kRepeat, false), {0.4375F, 0.5F});
  EXPECT_FLOAT_EQ(sample.color.y, 0.75F * srgb_to_linear(20) + 0.25F * srgb_to_linear(30));
}

/// Columns of the two texels that a bilinear look-up blends along x.
void expect_columns(Wrap wrap, float u, std::uint32_t first, std::uint32_t second) {
  const auto sample = sample_texture(row_of_greys(4, wrap, false), {u, 0.5F});
  EXPECT_EQ(sample.texels[0].x, first) << "u = " << u;
  EXPECT_EQ(sample.texels[1].x, second) << "u = " << u;
}

TEST(SampleTexture, BlendsAcrossTheBorderAsTheWrapModeSays) {
  expect_columns(Wrap::kRepeat, 0.05F, 3, 0);
  expect_columns(Wrap::kRepeat, 0.95F, 3, 0);
  expect_columns(Wrap::kMirroredRepeat, 0.05F, 0, 0);
  expect_columns(Wrap::kMirroredRepeat, 0.95F, 3, 3);
  expect_columns(Wrap::kMirroredRepeat, 1.95F, 0, 0);
  expect_columns(Wrap::kClampToEdge, 0.05F, 0, 0);
  expect_columns(Wrap::kClampToEdge, 0.95F, 3, 3);
}

TEST(SampleTexture, ReadsRowsFromTheTop) {
  Texture t;
  t.width = 1;
  t.height = 2;
  t.nearest = true;
  t.rgba = {255, 0, 0, 255, 0, 0, 255, 255};
  EXPECT_EQ(sample_texture(t, {0.5F, 0.25F}).color, Vec3(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(sample_texture(t, {0.5F, 0.75F}).color, Vec3(0.0F, 0.0F, 1.0F));
}

TEST(SampleTexture, StaysInsideForHostileCoordinates) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const float max = std::numeric_limits<float>::max();
  const float hostile[] = {nan,  inf,   -inf,   max,  -max,           1e-45F, -1e-45F, -1e-9F,
                           1.0F, 1e10F, -1e10F, 2.0F, 0x1.fffffep-1F, -2.0F,  -1.0F,   3.0F};
  for (const std::uint32_t width : {1U, 2U, 3U, 5U, 4096U}) {
    for (const Wrap wrap : {Wrap::kRepeat, Wrap::kMirroredRepeat, Wrap::kClampToEdge}) {
      for (const bool nearest : {false, true}) {
        Texture t = row_of_greys(width, wrap, nearest);
        t.wrap_v = wrap;
        for (const float u : hostile) {
          for (const float v : hostile) {
            const auto sample = sample_texture(t, {u, v});
            for (int i = 0; i < sample.num_texels; ++i) {
              ASSERT_LT(sample.texels[i].x, width) << u;
              ASSERT_EQ(sample.texels[i].y, 0U) << v;
            }
            ASSERT_TRUE(sample.color.x >= 0.0F && sample.color.x <= 1.0F) << u << ' ' << v;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace sheaf
