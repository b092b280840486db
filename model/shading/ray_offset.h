// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "geometry/box.h"
#include "geometry/vec.h"

namespace sheaf {

// Constants of C. Wächter and N. Binder, "A Fast and Robust Method for Avoiding Self-Intersection",
// Ray Tracing Gems (2019), chapter 6.
inline constexpr float kOffsetNearZero = 1.0F / 32.0F;  ///< below: a fixed step, in scene units
inline constexpr float kOffsetFixedStep = 1.0F / 65536.0F;
inline constexpr float kOffsetUlps = 256.0F;  ///< above: a step in units of last place

/// The authors tuned these constants for scenes of ordinary size. What is far from that gets more
/// or less; ordinary scenes get what the authors say. Decision 0060 derives the limits.
struct OffsetScale {
  float unit = 1.0F;   ///< of the fixed step and of the range in which it is taken
  float least = 0.0F;  ///< along the normal, whatever the coordinates
  float far = 0.0F;    ///< instead of all others, along the normal, if it is not 0
};

/// The unit of scenes whose largest coordinate is less than 1/4: the power of two below that
/// coordinate; else 1. An empty box has the unit 1.
[[nodiscard]] inline float offset_unit(const Box& bounds) {
  const Vec3 reach = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
  const float largest = std::max({reach.x, reach.y, reach.z});
  if (!(largest < 0.25F)) return 1.0F;
  return std::ldexp(1.0F, largest > 0.0F ? std::max(std::ilogb(largest), -100) : -100);
}

/// The least offset from a triangle whose edges reach as far as `reach` along an axis. Beyond 64
/// units, the 16 roundings of t in the triangle test may exceed what the coordinates ask for.
[[nodiscard]] inline float least_offset(float reach) {
  return reach > 64.0F ? 0x1p-20F * reach : 0.0F;
}

/// The step in scenes whose largest coordinate is more than 256 times their extent, else 0; the
/// paper's 256 ulps would reach across them. There 4 ulps of the largest coordinate are enough:
/// along a unit normal, rounding the position and the moved origin to coordinates takes half an ulp
/// an axis each, sqrt(3) ulps in all, and t is off by less than one. Decision 0107 has the numbers.
[[nodiscard]] inline float far_offset(const Box& bounds) {
  const Vec3 reach = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
  const float largest = std::max({reach.x, reach.y, reach.z});
  const Vec3 extent = bounds.extent();
  const bool is_far = largest > 256.0F * std::max({extent.x, extent.y, extent.z});
  if (!is_far || !std::isfinite(largest)) return 0.0F;
  return std::ldexp(1.0F, std::ilogb(largest) - 23 + 2);
}

/// One coordinate of offset_origin().
[[nodiscard]] inline float offset_coordinate(float p, float n, const OffsetScale& scale = {}) {
  if (scale.far > 0.0F) return p + scale.far * n;
  if (std::fabs(p) < kOffsetNearZero * scale.unit) {
    return p + std::max(kOffsetFixedStep * scale.unit, scale.least) * n;
  }
  const auto ulps = static_cast<std::int32_t>(kOffsetUlps * n);
  const auto bits = std::bit_cast<std::int32_t>(p);
  const auto moved = std::bit_cast<float>(p < 0.0F ? bits - ulps : bits + ulps);
  if (!std::isfinite(moved)) return p;  // beyond FLT_MAX there is nothing to meet
  const float step = scale.least * n;
  return std::fabs(moved - p) < std::fabs(step) ? p + step : moved;
}

/// Moves a point on a surface off it along the unit normal n, far enough that a ray from there
/// cannot meet the same surface again because of rounding. n points to the side that the new ray
/// leaves to.
[[nodiscard]] inline Vec3 offset_origin(const Vec3& p, const Vec3& n,
                                        const OffsetScale& scale = {}) {
  return {offset_coordinate(p.x, n.x, scale), offset_coordinate(p.y, n.y, scale),
          offset_coordinate(p.z, n.z, scale)};
}

}  // namespace sheaf
