// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "geometry/vec.h"
#include "kdtree/kd_tree.h"
#include "scene/scene.h"

namespace sheaf {

/// Where a double-precision ray met a triangle; u and v weigh its second and third vertex.
struct ReferenceHit {
  double t = 0.0;
  double u = 0.0;
  double v = 0.0;
  std::uint32_t triangle = 0;
};

struct ReferenceRay {
  Vec3d origin{0.0};
  Vec3d direction{0.0, 0.0, 1.0};  ///< unit
  double t_max = std::numeric_limits<double>::infinity();
};

/// Nearest hit with 0 <= t <= t_max; among equal t the lower primitive number.
[[nodiscard]] std::optional<ReferenceHit> reference_closest_hit(const Scene& scene,
                                                                const KdTree& tree,
                                                                const ReferenceRay& ray);

/// Whether anything is hit with 0 <= t < t_max.
[[nodiscard]] bool reference_occluded(const Scene& scene, const KdTree& tree,
                                      const ReferenceRay& ray);

}  // namespace sheaf
