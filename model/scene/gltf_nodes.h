// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "scene/gltf_accessor.h"
#include "scene/gltf_document.h"

namespace sheaf::gltf {

/// The placements that EXT_mesh_gpu_instancing gives a node's mesh. A missing attribute is the
/// identity; quantized rotations are normalized.
struct InstanceAttributes {
  std::uint64_t count = 1;
  AccessorView translation;  ///< count 0: not given
  AccessorView rotation;
  AccessorView scale;

  [[nodiscard]] glm::dmat4 transform(std::uint64_t i) const;
};

/// A node with a mesh.
struct PlacedMesh {
  int mesh = 0;
  glm::dmat4 world{1.0};
  InstanceAttributes instances;
};

/// A node with a camera or a light.
struct PlacedItem {
  int item = 0;  ///< index of the camera or light
  int node = 0;
  glm::dmat4 world{1.0};
};

/// The scene's nodes in world space, in depth-first order.
struct PlacedNodes {
  std::vector<PlacedMesh> meshes;
  std::vector<PlacedItem> cameras;
  std::vector<PlacedItem> lights;
};

/// Walks the default scene (else the first; without scenes, all nodes that are no node's child).
/// A node that is reached twice, by a cycle or from two parents, is refused.
[[nodiscard]] PlacedNodes place_nodes(const Document& document);

}  // namespace sheaf::gltf
