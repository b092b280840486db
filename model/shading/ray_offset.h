// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "geometry/vec.h"

namespace sheaf {

// Constants of C. Wächter and N. Binder, "A Fast and Robust Method for Avoiding Self-Intersection",
// Ray Tracing Gems (2019), chapter 6.
inline constexpr float kOffsetNearZero = 1.0F / 32.0F;  ///< below: a fixed step, in scene units
inline constexpr float kOffsetFixedStep = 1.0F / 65536.0F;
inline constexpr float kOffsetUlps = 256.0F;  ///< above: a step in units of last place

/// One coordinate of offset_origin().
[[nodiscard]] inline float offset_coordinate(float p, float n) {
  if (std::fabs(p) < kOffsetNearZero) {
    return p + kOffsetFixedStep * n;
  }
  const auto ulps = static_cast<std::int32_t>(kOffsetUlps * n);
  const auto bits = std::bit_cast<std::int32_t>(p);
  const float moved = std::bit_cast<float>(p < 0.0F ? bits - ulps : bits + ulps);
  return std::isfinite(moved) ? moved : p;  // beyond FLT_MAX there is nothing to meet
}

/// Moves a point on a surface off it along the unit normal n, far enough that a ray from there
/// cannot meet the same surface again because of rounding. n points to the side that the new ray
/// leaves to.
[[nodiscard]] inline Vec3 offset_origin(const Vec3& p, const Vec3& n) {
  return {offset_coordinate(p.x, n.x), offset_coordinate(p.y, n.y), offset_coordinate(p.z, n.z)};
}

}  // namespace sheaf
