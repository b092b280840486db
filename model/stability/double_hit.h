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
  /// farthest corner along the two axes that the shear mixes). Along either axis k of the two it is
  /// u (2 |k| + 4 |z|), see set_up_planes(), and so at most 4u (|k| + |z|); along both, sqrt(2)
  /// times that, which is 5.66u. The rest covers terms in u².
  double margin_error = 0.0;
  /// How far that, and the rounding of the weights and of t, may move t; infinite for triangles
  /// seen edge-on.
  double t_error = 0.0;
};
[[nodiscard]] DoubleHit hit_in_doubles(const TriangleRecord& triangle, const Ray& ray);

/// Whether `hit` is an answer that rounding can explain: the triangle is hit, or missed by less
/// than the error, t is right within the error, and no triangle is certainly hit before it.
/// Ordinary rays have errors of a few ulps, and then this says that the hit is the right one.
/// `t_slack` is how much farther t may be off if another arithmetic computed it.
[[nodiscard]] bool explains(const MeshScene& scene, const Ray& ray, const Hit& hit,
                            double t_slack = 0.0);

}  // namespace sheaf::stability
