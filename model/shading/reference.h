// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geometry/vec.h"
#include "kdtree/kd_tree.h"
#include "scene/scene.h"

namespace sheaf {

/// Plain recursive ray tracer in double precision: the oracle that the simulated machine's image is
/// held against. It follows the conventions of Shader (shader.h) and computes none of it with
/// Shader's code: camera, intersection, textures, Fresnel and lights are its own, written to be
/// read rather than to be fast.
///
/// Two choices keep the comparison fair. Origins are moved off surfaces by the same amount that
/// Wächter and Binder's method moves a float (256 float ulps, or 1/65536 near zero), so that both
/// tracers agree on what lies within that distance. Triangles are met by a watertight test in
/// double (reference_hit.h), since Möller–Trumbore's leaves gaps at shared edges in any precision.
///
/// Nothing saturates and no weight is rounded to float.
class ReferenceTracer {
 public:
  struct Options {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t recursion_level = 1;
    double weight_cutoff = 0.0;
  };
  /// The scene and the tree over it must outlive the tracer.
  ReferenceTracer(const Scene& scene, const KdTree& tree, const Options& options);

  /// Linear RGB of the pixel in column x and row y (row 0 is the top).
  [[nodiscard]] Vec3d pixel(std::uint32_t x, std::uint32_t y) const;

  /// What a ray of weight 1 and depth 0 brings back; direction is unit.
  [[nodiscard]] Vec3d radiance(const Vec3d& origin, const Vec3d& direction) const;

 private:
  const Scene& scene_;
  const KdTree& tree_;
  Options options_;
};

}  // namespace sheaf
