// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/film.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sheaf {
namespace {

constexpr float kFloatMax = std::numeric_limits<float>::max();
constexpr FilmFormat kFormats[] = {FilmFormat::kUnorm8, FilmFormat::kHalf, FilmFormat::kFloat,
                                   FilmFormat::kExact};

/// What a one-pixel film holds after `count` contributions of x.
float sum_of(FilmFormat format, float x, int count) {
  const auto film = make_film(format, 1);
  for (int i = 0; i < count; ++i) {
    film->add(0, Vec3(x));
  }
  return film->value(0).y;
}

/// What a one-pixel film holds after a and then b.
float sum_of_two(FilmFormat format, float a, float b) {
  const auto film = make_film(format, 1);
  film->add(0, Vec3(a));
  film->add(0, Vec3(b));
  return film->value(0).y;
}

TEST(Film, StartsBlackAndKeepsPixelsAndChannelsApart) {
  for (const FilmFormat format : kFormats) {
    const auto film = make_film(format, 3);
    film->add(1, {1.0F, 0.0F, 0.0F});
    film->add(2, {0.0F, 1.0F, 0.0F});
    film->add(2, {0.0F, 0.0F, 1.0F});
    EXPECT_EQ(film->value(0), Vec3(0.0F));
    EXPECT_EQ(film->value(1), Vec3(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(film->value(2), Vec3(0.0F, 1.0F, 1.0F));
  }
}

TEST(Film, TakesAPowerOfTwoOfBytesAPixel) {
  EXPECT_EQ(make_film(FilmFormat::kUnorm8, 1)->bytes_per_pixel(), 4U);
  EXPECT_EQ(make_film(FilmFormat::kHalf, 1)->bytes_per_pixel(), 8U);
  EXPECT_EQ(make_film(FilmFormat::kFloat, 1)->bytes_per_pixel(), 16U);
  EXPECT_EQ(make_film(FilmFormat::kExact, 1)->bytes_per_pixel(), 128U);
}

TEST(Film, RefusesContributionsThatNoShaderMayMake) {
  constexpr float kBad[] = {-1.0F, -1e-45F, std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN()};
  for (const FilmFormat format : kFormats) {
    const auto film = make_film(format, 1);
    for (const float bad : kBad) {
      EXPECT_THROW(film->add(0, {bad, 0.0F, 0.0F}), std::logic_error) << bad;
      EXPECT_THROW(film->add(0, {0.0F, bad, 0.0F}), std::logic_error) << bad;
      EXPECT_THROW(film->add(0, {0.0F, 0.0F, bad}), std::logic_error) << bad;
    }
    EXPECT_THROW(film->add(1, Vec3(0.0F)), std::logic_error);
    EXPECT_EQ(film->value(0), Vec3(0.0F));
  }
}

TEST(Film, TakesANegativeZeroAsZero) {
  for (const FilmFormat format : kFormats) {
    EXPECT_EQ(std::bit_cast<std::uint32_t>(sum_of_two(format, -0.0F, 0.0F)), 0U);
  }
}

TEST(FilmUnorm8, LosesAThousandContributionsOfAThousandth) {
  EXPECT_EQ(sum_of(FilmFormat::kUnorm8, 0.001F, 1000), 0.0F);
}

TEST(FilmUnorm8, RoundsToTheNearestOf256Steps) {
  EXPECT_EQ(sum_of(FilmFormat::kUnorm8, 0.0019F, 1), 0.0F);
  EXPECT_EQ(sum_of(FilmFormat::kUnorm8, 0.0021F, 1), 1.0F / 255.0F);
  EXPECT_EQ(sum_of(FilmFormat::kUnorm8, 0.5F, 1), 128.0F / 255.0F);
}

TEST(FilmUnorm8, SaturatesAtOne) {
  EXPECT_EQ(sum_of(FilmFormat::kUnorm8, 0.4F, 3), 1.0F);
  EXPECT_EQ(sum_of(FilmFormat::kUnorm8, kFloatMax, 2), 1.0F);
}

TEST(FilmHalf, RoundsTiesToEven) {
  EXPECT_EQ(sum_of_two(FilmFormat::kHalf, 1.0F, 0x1p-11F), 1.0F);
  EXPECT_EQ(sum_of_two(FilmFormat::kHalf, 1.0F + 0x1p-10F, 0x1p-11F), 1.0F + 0x1p-9F);
}

TEST(FilmHalf, RoundsOnceNotTwice) {
  // In single precision the sum would become the tie 1 + 2^-11, and that would go down to 1.
  EXPECT_EQ(sum_of_two(FilmFormat::kHalf, 1.0F, 0x1p-11F + 0x1p-34F), 1.0F + 0x1p-10F);
  // From below: it would become the tie 1 + 3·2^-11, and that would go up.
  EXPECT_EQ(sum_of_two(FilmFormat::kHalf, 1.0F + 0x1p-10F, 0x1p-11F - 0x1p-35F), 1.0F + 0x1p-10F);
}

TEST(FilmHalf, SaturatesAtItsLargestNumber) {
  EXPECT_EQ(sum_of(FilmFormat::kHalf, 65504.0F, 2), 65504.0F);
  EXPECT_EQ(sum_of(FilmFormat::kHalf, 65530.0F, 1), 65504.0F);
  EXPECT_EQ(sum_of(FilmFormat::kHalf, kFloatMax, 2), 65504.0F);
}

TEST(FilmHalf, KeepsDenormalsAndDropsWhatIsSmaller) {
  EXPECT_EQ(sum_of(FilmFormat::kHalf, 0x1p-24F, 3), 0x3p-24F);
  EXPECT_EQ(sum_of(FilmFormat::kHalf, 0x1p-26F, 100), 0.0F);
}

TEST(FilmFloat, RoundsAfterEveryContribution) {
  EXPECT_EQ(sum_of_two(FilmFormat::kFloat, 1.0F, 0x1p-24F), 1.0F);
  EXPECT_EQ(sum_of_two(FilmFormat::kFloat, 1.0F, 0x1p-23F), 1.0F + 0x1p-23F);
}

TEST(FilmFloat, SaturatesAtFloatMax) {
  EXPECT_EQ(sum_of(FilmFormat::kFloat, kFloatMax, 3), kFloatMax);
}

TEST(FilmExact, RoundsAMillionMillionthsOnce) {
  // 10^6 times a 24-bit number fits a double exactly.
  const auto expected = static_cast<float>(1e6 * static_cast<double>(1e-6F));
  EXPECT_EQ(sum_of(FilmFormat::kExact, 1e-6F, 1'000'000), expected);
  EXPECT_NE(sum_of(FilmFormat::kFloat, 1e-6F, 1'000'000), expected);
}

TEST(FilmExact, SaturatesAtFloatMax) {
  EXPECT_EQ(sum_of(FilmFormat::kExact, kFloatMax, 1000), kFloatMax);
}

}  // namespace
}  // namespace sheaf
