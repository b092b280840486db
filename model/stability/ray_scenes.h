// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stability/mesh_scene.h"

namespace sheaf::stability {

/// A mesh and rays to send at it, one of them extreme.
struct RayScene {
  std::string name;
  std::string extreme;
  Mesh mesh;
  /// A ray that makes things hard.
  std::function<Ray(const MeshScene&, Random&)> ray;
};
[[nodiscard]] std::vector<RayScene> ray_scenes();
/// The meshes of extreme_meshes.h: rays through the edges of those that nothing may leak through,
/// and rays that graze those which rays leave from.
[[nodiscard]] std::vector<RayScene> surface_ray_scenes();

}  // namespace sheaf::stability
