// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"

namespace sheaf::gltf {

/// A primitive that gives triangles.
struct PlannedPrimitive {
  int mesh = 0;
  std::string place;  ///< "/meshes/0/primitives/0"
  const tinygltf::Primitive* primitive = nullptr;
  std::uint64_t triangles = 0;     ///< of one instance
  std::uint64_t max_vertices = 0;  ///< of one instance, at most
};

/// What will be flattened, known before the first vertex is read.
struct GeometryPlan {
  std::vector<PlannedPrimitive> primitives;                ///< by mesh
  std::vector<std::vector<const PlacedMesh*>> placements;  ///< per mesh
  std::uint64_t triangles = 0;                             ///< of all instances, <= kMaxTriangles
  std::uint64_t max_vertices = 0;                          ///< of all instances, at most
  std::uint64_t instances = 0;                             ///< placements of meshes with triangles
};

/// Throws Refusal if there are no triangles or too many. `placed` must outlive the plan.
[[nodiscard]] GeometryPlan plan_geometry(Document& document, const PlacedNodes& placed);

}  // namespace sheaf::gltf
