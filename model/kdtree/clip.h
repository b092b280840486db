// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "geometry/box.h"
#include "geometry/vec.h"

namespace sheaf {

/// The boxes of the two parts of a triangle inside a cell that a plane divides.
struct SplitParts {
  Box left, right;
  bool in_left = false;   ///< some of the triangle lies in the left half
  bool in_right = false;  ///< some of the triangle lies in the right half
};

/// Clips a triangle to a cell and divides it at coordinate `plane` of `axis`, which lies strictly
/// inside the cell (Sutherland and Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974, in
/// double precision). The boxes are conservative: each holds all of the exact part, whatever the
/// rounding errors, and none of what is outside of the half cell or the triangle's own box. A part
/// that only touches the plane is given to the other side.
[[nodiscard]] SplitParts split_triangle(const std::array<Vec3, 3>& corners, const Box& cell,
                                        int axis, float plane);

}  // namespace sheaf
