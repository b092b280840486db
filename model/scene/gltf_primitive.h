// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/gltf_material.h"
#include "scene/gltf_plan.h"
#include "scene/scene.h"

namespace sheaf::gltf {

/// Appends primitives, placement by placement, to a scene's vertices and triangles.
class PrimitiveWriter {
 public:
  PrimitiveWriter(Document& document, Scene& scene, bool keep_uvs)
      : document_(document), scene_(scene), keep_uvs_(keep_uvs) {}

  void write(const PlannedPrimitive& planned, const std::vector<const PlacedMesh*>& placements,
             std::uint16_t material, const std::optional<UvSource>& uvs);

 private:
  /// A primitive's attributes and its topology, independent of where it is placed.
  struct Shape {
    AccessorView positions;
    AccessorView normals;  ///< count 0: none, flat normals are made
    AccessorView uvs;      ///< count 0: none or not needed
    glm::mat3 uv_transform{1.0F};
    std::vector<std::uint32_t> vertices;  ///< elements used, in order of first use
    /// Three indices into `vertices` a triangle; empty: every corner has a vertex of its own.
    std::vector<std::uint32_t> corners;
  };

  [[nodiscard]] Shape read_shape(const PlannedPrimitive& planned,
                                 const std::optional<UvSource>& uvs);
  void share_vertices(Shape& shape, std::uint64_t max_vertices);
  void write_instance(const Shape& shape, const glm::dmat4& world, std::uint16_t material);
  void write_positions(const Shape& shape, const glm::dmat4& world);
  void write_normals(const Shape& shape, const glm::dmat4& world, double side);
  void write_uvs(const Shape& shape);

  /// Where an element of the current primitive went; valid if its stamp is the current one, so
  /// that a small part of a shared accessor costs only its own size.
  struct Slot {
    std::uint32_t stamp = 0;
    std::uint32_t vertex = 0;
  };

  Document& document_;
  Scene& scene_;
  bool keep_uvs_;
  std::vector<Slot> slots_;
  std::uint32_t stamp_ = 0;
};

}  // namespace sheaf::gltf
