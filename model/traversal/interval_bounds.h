// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "traversal/packed_rays.h"

namespace sheaf {

/// The least and the greatest of some numbers.
struct Range {
  float lo = std::numeric_limits<float>::infinity();
  float hi = -std::numeric_limits<float>::infinity();
  void add(float x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
};

inline constexpr Range kAnything{-std::numeric_limits<float>::infinity(),
                                 std::numeric_limits<float>::infinity()};

/// All products of a number of `a` and one of `b` lie within. One that is not a number (0 ·
/// infinity) might be any.
[[nodiscard]] inline Range product(const Range& a, const Range& b) {
  Range range;
  for (const float x : {a.lo, a.hi}) {
    for (const float y : {b.lo, b.hi}) {
      const float xy = x * y;
      if (std::isnan(xy)) return kAnything;
      range.add(xy);
    }
  }
  return range;
}

/// What interval traversal knows of the rays of a pass. Rounding is monotonic, so that the same
/// operations on the ends of ranges, in the same order, bound what each ray would compute.
struct IntervalBounds {
  struct Axis {
    Range near_origin, far_origin, inverse;
  };
  std::array<Axis, 3> axis;
  float enter = std::numeric_limits<float>::infinity();   ///< the first ray's into the tree
  float leave = -std::numeric_limits<float>::infinity();  ///< the last ray's out of it

  IntervalBounds(const PackedRays& rays, LaneMask lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
      for (std::size_t a = 0; a < 3; ++a) {
        axis[a].near_origin.add(rays.axis[a].near_origin[i]);
        axis[a].far_origin.add(rays.axis[a].far_origin[i]);
        axis[a].inverse.add(rays.axis[a].inverse[i]);
      }
      enter = std::min(enter, rays.enter[i]);
      leave = std::max(leave, rays.leave[i]);
    }
  }

  /// Until when a ray may be on the near side of a plane, at the latest.
  [[nodiscard]] float near_until(std::size_t a, float split) const {
    const Range& o = axis[a].near_origin;
    return product({split - o.hi, split - o.lo}, axis[a].inverse).hi;
  }
  /// From when on a ray may be on its far side, at the earliest.
  [[nodiscard]] float far_from(std::size_t a, float split) const {
    const Range& o = axis[a].far_origin;
    return product({split - o.hi, split - o.lo}, axis[a].inverse).lo;
  }
};

}  // namespace sheaf
