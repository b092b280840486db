// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "stability/mesh_scene.h"

namespace sheaf::stability {

/// A convex closed mesh around `centre`.
struct ClosedMesh {
  std::string name, extreme;
  Mesh mesh;
  Vec3 centre{0.0F};
  float inner = 0.0F;  ///< origins inside lie this near to the centre
  float outer = 0.0F;  ///< origins outside lie this far away
  bool level = false;  ///< and at the height of the centre: the mesh reaches far up and down
};

/// What no ray may slip through.
[[nodiscard]] std::vector<ClosedMesh> closed_meshes();
/// Through an edge of the mesh, from inside or outside.
[[nodiscard]] Ray ray_at_edge(const ClosedMesh& closed, const MeshScene& scene, Random& random);

/// A mesh that rays leave from.
struct SurfaceMesh {
  std::string name, extreme;
  Mesh mesh;
  bool closed = false;  ///< around the middle of its bounds
};
[[nodiscard]] std::vector<SurfaceMesh> surface_meshes();
/// A ray that comes in at a random point of a random triangle, at an angle of 1 to 1e-6.
[[nodiscard]] Ray grazing_ray(const MeshScene& scene, Random& random);

}  // namespace sheaf::stability
