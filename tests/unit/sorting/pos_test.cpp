// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/pos.h"

#include <gtest/gtest.h>

namespace sheaf {
namespace {

const Vec3 kAnyDirection(0.0F, 0.0F, 1.0F);

Vec3 at(float x) {
  return {x, 0.0F, 0.0F};
}

TEST(Pos, GivesTheRayToTheNearestAnchorWithinX) {
  PosHeuristic pos(4.0F, 3);
  EXPECT_EQ(pos.find(at(0.0F), kAnyDirection), kNoCell);
  pos.open(0, at(0.0F), kAnyDirection);
  pos.open(2, at(3.0F), kAnyDirection);
  EXPECT_EQ(pos.find(at(1.4F), -kAnyDirection), 0U);
  EXPECT_EQ(pos.find(at(1.6F), kAnyDirection), 2U);
  EXPECT_EQ(pos.find(at(5.5F), kAnyDirection), kNoCell);
}

TEST(Pos, ComparesTheSquaredDistanceStrictly) {
  PosHeuristic pos(4.0F, 1);
  pos.open(0, at(0.0F), kAnyDirection);
  EXPECT_EQ(pos.find(at(2.0F), kAnyDirection), kNoCell);
  EXPECT_EQ(pos.find(at(1.9999F), kAnyDirection), 0U);
}

TEST(Pos, OfEquallyNearAnchorsTakesTheLowest) {
  PosHeuristic pos(4.0F, 3);
  pos.open(2, at(0.0F), kAnyDirection);
  pos.open(1, at(2.0F), kAnyDirection);
  EXPECT_EQ(pos.find(at(1.0F), kAnyDirection), 1U);
}

TEST(Pos, ForgetsTheAnchorOfAClosedCell) {
  PosHeuristic pos(4.0F, 2);
  pos.open(0, at(0.0F), kAnyDirection);
  pos.open(1, at(1.0F), kAnyDirection);
  pos.close(0);
  EXPECT_EQ(pos.find(at(0.0F), kAnyDirection), 1U);
  pos.close(1);
  EXPECT_EQ(pos.find(at(0.0F), kAnyDirection), kNoCell);
}

}  // namespace
}  // namespace sheaf
