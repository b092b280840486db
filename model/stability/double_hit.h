// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "stability/mesh_scene.h"

namespace sheaf::stability {

/// One triangle and one ray in double precision.
struct DoubleHit {
  /// Distance of the ray from the nearest edge's line, measured across the ray's main axis:
  /// positive inside the triangle, negative outside.
  double margin = 0.0;
  double t = 0.0;
  /// How far single precision may move the corners as the ray sees them: 6u × (distance of the
  /// farthest corner along the two axes that the shear mixes); see set_up_planes().
  double margin_error = 0.0;
  /// How far that, and the rounding of the weights, may move t.
  double t_error = 0.0;
};
[[nodiscard]] DoubleHit hit_in_doubles(const TriangleRecord& triangle, const Ray& ray);

/// Whether `hit` is an answer that rounding can explain: the triangle is hit, or missed by less
/// than the error, t is right within the error, and no triangle is certainly hit before it.
/// Ordinary rays have errors of a few ulps, and then this says that the hit is the right one.
[[nodiscard]] bool explains(const MeshScene& scene, const Ray& ray, const Hit& hit);

}  // namespace sheaf::stability
