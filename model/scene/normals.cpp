// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/normals.h"

#include <cmath>
#include <unordered_map>

namespace sheaf {
namespace {

const Vec3 kZero{0.0F};

/// Twice the triangle's area times its unit normal.
Vec3d area_normal(const Scene& scene, const std::array<std::uint32_t, 3>& t) {
  const Vec3d a(scene.positions[t[0]]);
  return glm::cross(Vec3d(scene.positions[t[1]]) - a, Vec3d(scene.positions[t[2]]) - a);
}

Vec3 unit_or_up(const Vec3d& v) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? Vec3(v / length) : Vec3(0.0F, 1.0F, 0.0F);
}

bool belongs_to_one_triangle(const Scene& scene, std::size_t first_vertex,
                             std::size_t first_triangle) {
  return scene.positions.size() - first_vertex == 3 * (scene.triangles.size() - first_triangle);
}

}  // namespace

void fill_missing_normals(Scene& scene, std::size_t first_vertex, std::size_t first_triangle) {
  // Without shared vertices nothing has to be summed, which saves the sums of a big flat mesh.
  const bool direct = belongs_to_one_triangle(scene, first_vertex, first_triangle);
  std::unordered_map<std::uint32_t, Vec3d> sums;
  for (std::size_t i = first_triangle; i < scene.triangles.size(); ++i) {
    const auto& triangle = scene.triangles[i];
    for (const std::uint32_t vertex : triangle) {
      if (scene.normals[vertex] != kZero) continue;
      const Vec3d normal = area_normal(scene, triangle);
      if (direct) {
        scene.normals[vertex] = unit_or_up(normal);
      } else {
        sums.try_emplace(vertex, 0.0).first->second += normal;
      }
    }
  }
  for (const auto& [vertex, sum] : sums) scene.normals[vertex] = unit_or_up(sum);
}

}  // namespace sheaf
