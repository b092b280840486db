// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/watertight.h"
#include "traversal/trace.h"

namespace sheaf::stability {

/// One triangle and one ray in integer arithmetic without any rounding: floats are whole multiples
/// of 2^-149. The figures are rounded to double once, at the end.
struct ExactHit {
  double margin = 0.0;  ///< as in DoubleHit
  double t = 0.0;       ///< infinity where the ray runs along the triangle's plane
};
[[nodiscard]] ExactHit hit_exactly(const TriangleRecord& triangle, const Ray& ray);

/// Whether the sheared triangle contains the z axis, edges and corners included: what hit_sheared()
/// decides. False for triangles without area in that projection.
[[nodiscard]] bool contains_axis(const ShearedTriangle& triangle);

}  // namespace sheaf::stability
