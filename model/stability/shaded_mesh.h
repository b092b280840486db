// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "stability/mesh.h"

namespace sheaf::stability {

/// A scene of one mesh and one material, flat-shaded, without a light, framed by the camera.
[[nodiscard]] Scene scene_of(const Mesh& mesh, const Material& material);

struct Picture {
  std::vector<Vec3> pixels;
  std::uint64_t num_rays = 0;
};
/// Renders a scene without time. `settings` are those of --set; the picture is 16 × 16 pixels in
/// the exact film unless they say otherwise.
[[nodiscard]] Picture render(const Scene& scene, const std::vector<std::string>& settings = {});

}  // namespace sheaf::stability
