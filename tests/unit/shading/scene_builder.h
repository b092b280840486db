// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "kdtree/kd_tree.h"
#include "scene/scene.h"
#include "shading/shader.h"

namespace sheaf::test {

/// Puts small scenes together; every triangle gets vertices of its own.
class SceneBuilder {
 public:
  std::uint16_t material(const Material& m) {
    scene.materials.push_back(m);
    return static_cast<std::uint16_t>(scene.materials.size() - 1);
  }

  /// A triangle with one normal for each corner; returns its number.
  std::uint32_t triangle(const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals,
                         std::uint16_t material_index = 0,
                         const std::array<Vec2, 3>& uvs = {Vec2(0.0F), Vec2(1.0F, 0.0F),
                                                           Vec2(0.0F, 1.0F)}) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (std::size_t i = 0; i < 3; ++i) {
      scene.positions.push_back(corners[i]);
      scene.normals.push_back(normals[i]);
      scene.uvs.push_back(uvs[i]);
      scene.bounds.add(corners[i]);
    }
    scene.triangles.push_back({first, first + 1, first + 2});
    scene.triangle_material.push_back(material_index);
    return static_cast<std::uint32_t>(scene.triangles.size() - 1);
  }

  std::uint32_t flat_triangle(const std::array<Vec3, 3>& c, std::uint16_t material_index = 0) {
    const Vec3 n = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
    return triangle(c, {n, n, n}, material_index);
  }

  /// The parallelogram corner, corner + a, corner + a + b, corner + b; front side along a × b.
  void quad(const Vec3& corner, const Vec3& a, const Vec3& b, std::uint16_t material_index = 0) {
    flat_triangle({corner, corner + a, corner + a + b}, material_index);
    flat_triangle({corner, corner + a + b, corner + b}, material_index);
  }

  /// A sphere of 2 · rings · rings triangles with smooth normals.
  void sphere(const Vec3& centre, float radius, int rings, std::uint16_t material_index = 0) {
    const auto normal = [&](int i, int j) {
      const bool pole = i == 0 || i == rings;  // one point, whatever j
      const double theta = 3.14159265358979 * i / rings;
      const double phi = 2.0 * 3.14159265358979 * (j % rings) / rings;
      const double ring = pole ? 0.0 : std::sin(theta);
      return Vec3(Vec3d(ring * std::cos(phi), std::cos(theta), -ring * std::sin(phi)));
    };
    for (int i = 0; i < rings; ++i) {
      for (int j = 0; j < rings; ++j) {
        const Vec3 a = normal(i, j);
        const Vec3 b = normal(i + 1, j);
        const Vec3 c = normal(i + 1, j + 1);
        const Vec3 d = normal(i, j + 1);
        const auto at = [&](const Vec3& n) { return centre + radius * n; };
        if (i + 1 < rings) triangle({at(a), at(b), at(c)}, {a, b, c}, material_index);
        if (i > 0) triangle({at(a), at(c), at(d)}, {a, c, d}, material_index);
      }
    }
  }

  Scene scene;
};

/// All triangles in one leaf.
inline KdTree single_leaf(const Scene& scene) {
  KdTree tree;
  const auto count = static_cast<std::uint32_t>(scene.triangles.size());
  tree.nodes = {KdNode::leaf(0, count)};
  for (std::uint32_t i = 0; i < count; ++i) {
    tree.leaf_triangles.push_back(i);
  }
  tree.bounds = scene.bounds;
  return tree;
}

/// A ray of weight 1 and depth 0 from `from` towards `to`.
inline Ray ray_between(const Vec3& from, const Vec3& to) {
  Ray ray;
  ray.origin = from;
  ray.direction = glm::normalize(to - from);
  ray.t_max = std::numeric_limits<float>::infinity();
  ray.weight = Vec3(1.0F);
  ray.tag.id = primary_ray_id(5);
  ray.tag.pixel = 5;
  return ray;
}

/// A one-triangle floor in the plane y = 0, front side up, met at (0, 0, 0) where u = v = 1/4.
struct Floor {
  explicit Floor(const Material& material) {
    builder.material(material);
    builder.flat_triangle(
        {Vec3(-1.0F, 0.0F, 1.0F), Vec3(3.0F, 0.0F, 1.0F), Vec3(-1.0F, 0.0F, -3.0F)});
  }
  [[nodiscard]] const Scene& scene() const { return builder.scene; }
  SceneBuilder builder;
  Hit hit{1.0F, 0.25F, 0.25F, 0};
};

}  // namespace sheaf::test
