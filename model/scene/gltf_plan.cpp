// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/gltf_limits.h"

namespace sheaf::gltf {
namespace {

/// Vertices that the primitive strings together: its indices, or its positions.
std::uint64_t num_corners(const Document& document, const tinygltf::Primitive& primitive,
                          int positions, const std::string& place) {
  return primitive.indices >= 0
             ? AccessorView(document, place + "/indices", primitive.indices).count()
             : AccessorView(document, place + "/attributes/POSITION", positions).count();
}

std::uint64_t num_triangles(Document& document, const tinygltf::Primitive& primitive,
                            const std::string& place) {
  if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode <= TINYGLTF_MODE_LINE_STRIP) {
    document.warnings.add("points and lines are left out");
    return 0;
  }
  const auto positions = primitive.attributes.find("POSITION");
  if (positions == primitive.attributes.end()) {
    document.warnings.add("primitives without positions are left out");
    return 0;
  }
  const std::uint64_t corners = num_corners(document, primitive, positions->second, place);
  switch (primitive.mode) {
    case TINYGLTF_MODE_TRIANGLES:
      if (corners % 3 != 0) document.warnings.add("incomplete triangles are left out");
      return corners / 3;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
    case TINYGLTF_MODE_TRIANGLE_FAN:
      return corners < 3 ? 0 : corners - 2;
    default:
      refuse(place + "/mode", fmt::format("{} is not a primitive mode", primitive.mode));
  }
}

/// Only a primitive with normals can share vertices between triangles; flat normals need their own.
std::uint64_t max_vertices(const Document& document, const tinygltf::Primitive& primitive,
                           const std::string& place, std::uint64_t triangles) {
  if (!primitive.attributes.contains("NORMAL")) return 3 * triangles;
  const AccessorView positions(document, place + "/attributes/POSITION",
                               primitive.attributes.at("POSITION"));
  return std::min(3 * triangles, positions.count());
}

class Planner {
 public:
  Planner(Document& document, GeometryPlan& plan) : document_(document), plan_(plan) {}

  void add_mesh(int index, std::uint64_t instances) {
    const tinygltf::Mesh& mesh = document_.model.meshes[static_cast<std::size_t>(index)];
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      const tinygltf::Primitive& primitive = mesh.primitives[i];
      const std::string place = fmt::format("/meshes/{}/primitives/{}", index, i);
      const std::uint64_t count = num_triangles(document_, primitive, place);
      if (count == 0) continue;
      if (!primitive.targets.empty()) {
        document_.warnings.add("morph targets are left out; meshes have their rest shape");
      }
      add_triangles(count, instances, place);
      triangles += count;
      const std::uint64_t vertices = max_vertices(document_, primitive, place, count);
      plan_.max_vertices += vertices * instances;
      plan_.primitives.push_back({index, place, &primitive, count, vertices});
    }
    if (triangles > 0) plan_.instances += instances;
  }

 private:
  void add_triangles(std::uint64_t triangles, std::uint64_t instances, const std::string& place) {
    // Neither factor is large enough to wrap: a triangle takes a byte of the file at least, or is
    // one of kMaxZeroElements, and place_nodes bounds the instances.
    const std::uint64_t product = triangles * instances;
    if (plan_.triangles + product > kMaxTriangles) {
      refuse(place, fmt::format("{} triangles in {} instances exceed the scene's limit of {}",
                                triangles, instances, kMaxTriangles));
    }
    plan_.triangles += product;
  }

  Document& document_;
  GeometryPlan& plan_;
};

}  // namespace

GeometryPlan plan_geometry(Document& document, const PlacedNodes& placed) {
  GeometryPlan plan;
  const std::size_t num_meshes = document.model.meshes.size();
  plan.placements.resize(num_meshes);
  std::vector<std::uint64_t> instances(num_meshes, 0);
  for (const PlacedMesh& mesh : placed.meshes) {
    const auto index = static_cast<std::size_t>(mesh.mesh);
    if (index >= num_meshes) refuse("/nodes", fmt::format("there is no mesh {}", mesh.mesh));
    instances[index] += mesh.instances.count;
    plan.placements[index].push_back(&mesh);
  }
  Planner planner(document, plan);
  for (std::size_t i = 0; i < num_meshes; ++i) {
    if (instances[i] > 0) planner.add_mesh(static_cast<int>(i), instances[i]);
  }
  if (plan.triangles == 0) refuse("", "the scene has no triangles; points and lines are not shown");
  return plan;
}

}  // namespace sheaf::gltf
