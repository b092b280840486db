// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sorting/keyed.h"

namespace sheaf {

/// fastpos: the octant of the scene's bounding box in which the ray's origin lies.
class FastposHeuristic final : public KeyedHeuristic {
 public:
  FastposHeuristic(const Box& bounds, std::uint32_t num_cells)
      : KeyedHeuristic(8, num_cells), centre_(bounds.lo * 0.5F + bounds.hi * 0.5F) {}
  [[nodiscard]] std::uint32_t key(const Vec3& origin, const Vec3& /*direction*/) const override {
    return (origin.x < centre_.x ? 1U : 0U) | (origin.y < centre_.y ? 2U : 0U) |
           (origin.z < centre_.z ? 4U : 0U);
  }

 private:
  Vec3 centre_;
};

}  // namespace sheaf
