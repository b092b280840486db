// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "sorting/keyed.h"

namespace sheaf {

/// 3-bit code of a direction's signs, bit i for axis i; the sign of a zero is its sign bit.
[[nodiscard]] inline std::uint32_t sign_code(const Vec3& direction) {
  return (std::signbit(direction.x) ? 1U : 0U) | (std::signbit(direction.y) ? 2U : 0U) |
         (std::signbit(direction.z) ? 4U : 0U);
}

/// dir: the direction's octant.
class DirHeuristic final : public KeyedHeuristic {
 public:
  explicit DirHeuristic(std::uint32_t num_cells) : KeyedHeuristic(8, num_cells) {}
  [[nodiscard]] std::uint32_t key(const Vec3& /*origin*/, const Vec3& direction) const override {
    return sign_code(direction);
  }
};

}  // namespace sheaf
