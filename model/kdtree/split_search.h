// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/box.h"
#include "kdtree/split_event.h"

namespace sheaf {

/// Constants of the surface area heuristic.
struct SahCosts {
  double traversal = 15.0;
  double intersection = 20.0;
  double empty_bonus = 0.8;
};

/// Half the surface area of a cell; the factor cancels wherever areas are compared.
[[nodiscard]] inline double half_area(const Box& cell) {
  const Vec3d e = Vec3d(cell.hi) - Vec3d(cell.lo);
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

struct SplitPlane {
  int axis = -1;             ///< -1: no split is cheaper than a leaf
  float position = 0.0F;     ///< strictly inside the node's cell
  bool planar_left = false;  ///< triangles in the plane go to the left child
  [[nodiscard]] bool found() const { return axis >= 0; }
};

/// The cheapest split plane of a node among all faces of its triangles' boxes, by
///   cost = [λ] (K_T + K_I (A_left n_left + A_right n_right) / A)
/// (Wald and Havran 2006, equations 3 and 4; λ is the empty-space bonus), if it is cheaper than the
/// leaf's K_I n. A cell without area has none. Of equally cheap planes the first counts, axis by
/// axis and upward.
[[nodiscard]] SplitPlane find_split(const NodeEvents& events, const Box& cell,
                                    const SahCosts& costs);

}  // namespace sheaf
