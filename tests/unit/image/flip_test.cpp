// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace sheaf {
namespace {

constexpr std::uint32_t kWidth = 48;
constexpr std::uint32_t kHeight = 32;
using Picture = std::vector<Vec3>;

// Waves, checks and a texture of high frequency, different for each k.
Picture picture(int k) {
  Picture pixels;
  for (int y = 0; y < static_cast<int>(kHeight); ++y) {
    for (int x = 0; x < static_cast<int>(kWidth); ++x) {
      const double wave = 0.5 + 0.5 * std::sin(0.3 * x + k * 0.1 * y);
      const double checks = (x / 4 + y / 3) % 2 * 0.8 + 0.1 * k;
      const double texture = x * y % 17 / 16.0;
      pixels.emplace_back(wave, checks, texture);
    }
  }
  return pixels;
}

double flip(const Picture& image, const Picture& reference) {
  return ldr_flip(image, reference, kWidth, kHeight);
}

Picture scaled(Picture pixels, float factor, float offset) {
  for (Vec3& p : pixels) p = glm::clamp(p * factor + offset, 0.0F, 1.0F);
  return pixels;
}

// The expected figures are those of the PyPI package flip-evaluator 1.7, by the authors of FLIP:
//   evaluate(reference, test, "LDR", inputsRGB=False)
// with the same pictures in single precision.
constexpr double kSinglePrecision = 2e-5;

TEST(Flip, AgreesWithItsAuthorsOnPicturesThatDifferMuch) {
  EXPECT_NEAR(flip(picture(1), picture(2)), 0.6146438717842102, kSinglePrecision);
}

TEST(Flip, AgreesWithItsAuthorsOnADarkerPicture) {
  EXPECT_NEAR(flip(scaled(picture(1), 0.9F, 0.0F), picture(2)), 0.6415812373161316,
              kSinglePrecision);
}

TEST(Flip, AgreesWithItsAuthorsOnASmallOffset) {
  EXPECT_NEAR(flip(scaled(picture(2), 1.0F, 0.004F), picture(2)), 0.028614124283194542,
              kSinglePrecision);
}

TEST(Flip, AgreesWithItsAuthorsOnBlackAndWhite) {
  const Picture black(kWidth * kHeight, Vec3(0.0F));
  const Picture white(kWidth * kHeight, Vec3(1.0F));
  EXPECT_NEAR(flip(black, white), 0.9673991203308105, kSinglePrecision);
}

TEST(Flip, IsNothingForTheSamePicture) {
  EXPECT_EQ(flip(picture(1), picture(1)), 0.0);
}

TEST(Flip, SeesOnlyWhatAScreenShows) {
  EXPECT_EQ(flip(scaled(picture(1), 1.0F, 0.0F), picture(1)), 0.0);
  Picture bright(kWidth * kHeight, Vec3(1.0F));
  EXPECT_EQ(flip(Picture(kWidth * kHeight, Vec3(7.0F)), bright), 0.0);
}

TEST(Flip, RefusesPicturesOfAnotherSize) {
  const Picture one(1, Vec3(0.0F));
  EXPECT_THROW(static_cast<void>(ldr_flip(one, picture(1), kWidth, kHeight)), std::logic_error);
  EXPECT_THROW(static_cast<void>(ldr_flip({}, {}, 0, 0)), std::logic_error);
}

}  // namespace
}  // namespace sheaf
