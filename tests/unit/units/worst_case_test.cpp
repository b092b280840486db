// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "units/flow_control.h"

namespace sheaf {
namespace {

std::uint64_t of(const WorstCase& worst_case, std::uint8_t depth,
                 RayKind kind = RayKind::kReflection) {
  RayTag tag;
  tag.depth = depth;
  tag.kind = kind;
  return worst_case.of(tag);
}

TEST(WorstCase, GrowsByBranchesFromTheDeepestLevelUp) {
  // Three lights, two branches, level 2: 3, then 3 + 2·3, then 3 + 2·9.
  const WorstCase worst_case(2, 3, 2);
  EXPECT_EQ(of(worst_case, 2), 3U);
  EXPECT_EQ(of(worst_case, 1), 9U);
  EXPECT_EQ(of(worst_case, 0, RayKind::kPrimary), 21U);
}

TEST(WorstCase, WithOneBranchAddsTheLightsOfEveryLevel) {
  const WorstCase worst_case(4, 2, 1);
  EXPECT_EQ(of(worst_case, 0), 10U);
  EXPECT_EQ(of(worst_case, 3), 4U);
}

TEST(WorstCase, IsNeverLessThanTheRayItself) {
  EXPECT_EQ(of(WorstCase(0, 0, 0), 0), 1U);
  EXPECT_EQ(of(WorstCase(3, 0, 0), 0), 1U);
  EXPECT_EQ(of(WorstCase(3, 0, 1), 0), 1U);
  EXPECT_EQ(of(WorstCase(3, 0, 2), 0), 8U);
}

TEST(WorstCase, OfAShadowRayIsOneEvenBelowTheDeepestLevel) {
  const WorstCase worst_case(1, 5, 2);
  EXPECT_EQ(of(worst_case, 1, RayKind::kShadow), 1U);
  EXPECT_EQ(of(worst_case, 2, RayKind::kShadow), 1U);
}

TEST(WorstCase, SaturatesAtItsCeilingInsteadOfWrapping) {
  const WorstCase worst_case(200, 1000, 2);
  EXPECT_EQ(of(worst_case, 0), WorstCase::kCeiling);
  EXPECT_EQ(of(worst_case, 100), WorstCase::kCeiling);
  EXPECT_EQ(of(worst_case, 199), 3000U);
}

}  // namespace
}  // namespace sheaf
