// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"
#include "shading/reference_hit.h"

namespace sheaf {

/// A hit point in double precision, by the conventions of Surface (shader.h).
struct ReferenceSurface {
  Vec3d position{0.0};
  Vec3d geometric_normal{0.0};
  Vec3d shading_normal{0.0};
  bool entering = true;
  const Material* material = nullptr;
  Vec3d base_color{0.0};
  Vec3d emission{0.0};
  double offset_unit = 1.0;
  double least_offset = 0.0;
  double far_offset = 0.0;
};

[[nodiscard]] ReferenceSurface reference_surface(const Scene& scene, const ReferenceRay& ray,
                                                 const ReferenceHit& hit);

}  // namespace sheaf
