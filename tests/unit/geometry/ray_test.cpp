// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/ray.h"

#include <gtest/gtest.h>

#include <unordered_set>

namespace sheaf {
namespace {

TEST(RayId, DiffersBetweenPixelsAndBetweenThePathsOfAPixel) {
  std::unordered_set<std::uint64_t> ids;
  std::size_t made = 0;
  for (std::uint32_t pixel = 0; pixel < 10000; ++pixel) {
    const std::uint64_t primary = primary_ray_id(pixel);
    ids.insert(primary);
    ++made;
    for (std::uint32_t slot = 0; slot < 4; ++slot) {
      const std::uint64_t child = child_ray_id(primary, slot);
      ids.insert(child);
      ids.insert(child_ray_id(child, slot));
      made += 2;
    }
  }
  EXPECT_EQ(ids.size(), made);
}

}  // namespace
}  // namespace sheaf
