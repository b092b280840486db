// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/exact_sum.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/random.h"

namespace sheaf {
namespace {

constexpr float kSmallest = 0x1p-149F;
constexpr float kFloatMax = std::numeric_limits<float>::max();

float sum(const std::vector<float>& values) {
  ExactSum s;
  for (const float value : values) {
    s.add(value);
  }
  return s.value();
}

TEST(ExactSum, IsZeroAtFirst) {
  EXPECT_EQ(std::bit_cast<std::uint32_t>(ExactSum().value()), 0U);
}

TEST(ExactSum, GivesBackEveryFloat) {
  // All exponents, with mantissas at both ends and in the middle.
  for (std::uint32_t exponent = 0; exponent < 255; ++exponent) {
    for (const std::uint32_t fraction : {0U, 1U, 0x2aaaaaU, 0x555555U, 0x7fffffU}) {
      const float x = std::bit_cast<float>(exponent << 23 | fraction);
      EXPECT_EQ(sum({x}), x);
    }
  }
}

TEST(ExactSum, AddsDenormals) {
  EXPECT_EQ(sum({kSmallest, kSmallest, kSmallest}), 3.0F * kSmallest);
  EXPECT_EQ(sum({0x1p-126F, kSmallest}), 0x1p-126F + kSmallest);
}

TEST(ExactSum, RoundsTiesToEven) {
  EXPECT_EQ(sum({1.0F, 0x1p-24F}), 1.0F);
  EXPECT_EQ(sum({1.0F + 0x1p-23F, 0x1p-24F}), 1.0F + 0x1p-22F);
}

TEST(ExactSum, LetsTheSmallestNumberBreakATie) {
  for (int exponent = -100; exponent < 127; ++exponent) {
    const float one = std::ldexp(1.0F, exponent);
    EXPECT_EQ(sum({one, std::ldexp(one, -24), kSmallest}), std::ldexp(1.0F + 0x1p-23F, exponent));
  }
}

TEST(ExactSum, CarriesThroughAllWords) {
  // Ones in all bits from 2^-149 to 2^100, then one more at the bottom.
  ExactSum s;
  for (int exponent = -149; exponent <= 100; ++exponent) {
    s.add(std::ldexp(1.0F, exponent));
  }
  s.add(kSmallest);
  EXPECT_EQ(s.value(), 0x1p101F);
  s.add(0x1p78F);  // an ulp: had a bit been left behind anywhere, half of it would now show
  s.add(0x1p77F);
  EXPECT_EQ(s.value(), 0x1p101F + 0x1p79F);
}

TEST(ExactSum, SaturatesAndStillCounts) {
  ExactSum s;
  for (int i = 0; i < 100'000; ++i) {
    s.add(kFloatMax);
  }
  EXPECT_EQ(s.value(), kFloatMax);
  EXPECT_EQ(sum({kFloatMax, 0x1p102F}), kFloatMax);  // less than half an ulp above
  EXPECT_EQ(sum({kFloatMax, 0x1p103F}), kFloatMax);  // would round to infinity
}

/// 24-bit floats on a common 2^-30 grid, whose sum as an integer the compiler rounds to float.
TEST(ExactSum, EqualsIntegerSumsAtEveryScale) {
  Random random(7);
  for (int scale = -119; scale <= 60; ++scale) {
    ExactSum s;
    std::int64_t integer = 0;
    for (int i = 0; i < 200; ++i) {
      const auto mantissa = static_cast<std::int64_t>(random.below(1U << 24));
      const int shift = static_cast<int>(random.below(30));
      integer += mantissa << shift;
      s.add(std::ldexp(static_cast<float>(mantissa), shift - 30 + scale));
      ASSERT_EQ(s.value(), std::ldexp(static_cast<float>(integer), scale - 30))
          << "scale " << scale << ", " << i + 1 << " terms";
    }
  }
}

TEST(ExactSum, DoesNotDependOnTheOrder) {
  Random random(11);
  std::vector<float> values;
  for (int i = 0; i < 2000; ++i) {
    values.push_back(std::pow(10.0F, 60.0F * random.uniform() - 30.0F));
  }
  const float expected = sum(values);
  float plain_first = 0.0F;
  bool plain_differs = false;
  for (int round = 0; round < 20; ++round) {
    for (std::size_t i = values.size(); i > 1; --i) {
      std::swap(values[i - 1], values[random.below(i)]);
    }
    ASSERT_EQ(sum(values), expected);
    float plain = 0.0F;
    for (const float value : values) {
      plain += value;
    }
    plain_first = round == 0 ? plain : plain_first;
    plain_differs = plain_differs || plain != plain_first;
  }
  EXPECT_TRUE(plain_differs) << "the values are too tame: float sums do not show their order";
}

}  // namespace
}  // namespace sheaf
