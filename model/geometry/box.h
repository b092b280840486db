// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "geometry/vec.h"

namespace sheaf {

/// Axis-aligned box [lo, hi]; empty (lo > hi) until something is added.
struct Box {
  Vec3 lo{std::numeric_limits<float>::infinity()};
  Vec3 hi{-std::numeric_limits<float>::infinity()};

  void add(const Vec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  [[nodiscard]] Vec3 extent() const { return hi - lo; }
  /// Surface area; 0 for an empty box.
  [[nodiscard]] float area() const {
    const Vec3 e = glm::max(extent(), Vec3(0.0F));
    return 2.0F * (e.x * e.y + e.y * e.z + e.z * e.x);
  }
  [[nodiscard]] bool operator==(const Box&) const = default;
};

}  // namespace sheaf
