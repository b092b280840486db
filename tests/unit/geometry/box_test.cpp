// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/box.h"

#include <gtest/gtest.h>

namespace sheaf {
namespace {

TEST(Box, EmptyUntilAPointIsAdded) {
  Box box;
  EXPECT_EQ(box.area(), 0.0F);
  box.add(Vec3(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(box.lo, Vec3(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(box.hi, Vec3(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(box.area(), 0.0F);
}

TEST(Box, HoldsAllPointsAdded) {
  Box box;
  box.add(Vec3(1.0F, -2.0F, 0.0F));
  box.add(Vec3(-1.0F, 1.0F, 4.0F));
  EXPECT_EQ(box.lo, Vec3(-1.0F, -2.0F, 0.0F));
  EXPECT_EQ(box.extent(), Vec3(2.0F, 3.0F, 4.0F));
  EXPECT_EQ(box.area(), 2.0F * (2.0F * 3.0F + 3.0F * 4.0F + 4.0F * 2.0F));
}

}  // namespace
}  // namespace sheaf
