// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "config/config.h"
#include "geometry/watertight.h"
#include "traversal/trace.h"

namespace sheaf::stability {

// Integer arithmetic without any rounding: floats are whole multiples of 2^-149. Results are
// rounded to double at the end, to an ulp or two.

/// One triangle and one ray.
struct ExactHit {
  double margin = 0.0;  ///< as in DoubleHit
  double t = 0.0;       ///< infinity where the ray runs along the triangle's plane
};
[[nodiscard]] ExactHit hit_exactly(const TriangleRecord& triangle, const Ray& ray);

/// Whether all corners of two triangles lie in one plane. True if `a` has no area.
[[nodiscard]] bool are_coplanar(const TriangleRecord& a, const TriangleRecord& b);

/// Whether the sheared triangle contains the z axis, edges and corners included: what hit_sheared()
/// decides. False for triangles without area in that projection.
[[nodiscard]] bool contains_axis(const ShearedTriangle& triangle);

/// The sum of finite floats.
[[nodiscard]] double sum_exactly(std::span<const float> terms);

/// What a film's channel that rounds after every contribution holds after each of `terms`, by its
/// definition (film.h): the sum of what is stored and a term, rounded once.
[[nodiscard]] std::vector<float> sums_by_definition(FilmFormat format,
                                                    std::span<const float> terms);

}  // namespace sheaf::stability
