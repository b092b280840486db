// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/extreme_meshes.h"

#include <cmath>
#include <utility>

namespace sheaf::stability {
namespace {

Vec3 centre_of(float scale, float offset) {
  return scale * offset * Vec3(1.0F, -1.0F, 1.0F);
}

Mesh moved_sphere(float scale, float offset, int rings = 40, int sectors = 60) {
  Mesh mesh = bumpy_sphere(rings, sectors, 0.0F);
  mesh.transform(scale, centre_of(scale, offset));
  return mesh;
}

ClosedMesh sphere(std::string name, std::string extreme, int rings, int sectors, float scale,
                  float offset) {
  ClosedMesh closed{std::move(name), std::move(extreme),
                    moved_sphere(scale, offset, rings, sectors)};
  closed.centre = centre_of(scale, offset);
  closed.inner = 0.4F * scale;
  closed.outer = 3.0F * scale;
  return closed;
}

/// Triangles as large as the scene whose planes pass near the origin, where coordinates are small
/// but their errors are not.
Mesh large_through_zero(float scale) {
  Mesh mesh;
  Random random(63);
  for (int i = 0; i < 60; ++i) {
    const Vec3 u = scale * random_direction(random);
    const Vec3 v = scale * random_direction(random);
    const Vec3 at = scale * 1e-3F * (random_point(random) - Vec3(0.5F));
    mesh.add(at - 0.5F * u - 0.3F * v, at + 0.5F * u - 0.3F * v, at + 0.7F * v);
  }
  return mesh;
}

}  // namespace

std::vector<ClosedMesh> closed_meshes() {
  std::vector<ClosedMesh> meshes;
  meshes.push_back(sphere("sphere", "rays at edges and corners", 40, 60, 1.0F, 0.0F));
  meshes.push_back(
      sphere("sphere moved", "the same 10,000 radii from the origin", 30, 40, 1.0F, 1e4F));
  meshes.push_back(
      sphere("sphere moved far", "the same 100,000 radii from the origin", 30, 40, 1.0F, 1e5F));
  meshes.push_back(sphere("sphere moved farthest",
                          "1,000,000 radii from the origin: four bits are left", 8, 12, 1.0F,
                          1e6F));
  meshes.push_back(sphere("tiny sphere", "the same scaled by 1e-6", 30, 40, 1e-6F, 0.0F));
  meshes.push_back(sphere("huge sphere", "the same scaled by 1e6", 30, 40, 1e6F, 0.0F));
  meshes.push_back(sphere("sphere of needles",
                          "triangles 600 times as long as wide, all meeting "
                          "at two poles",
                          4, 5000, 1.0F, 0.0F));
  meshes.push_back({"spindle", "needles 1,000,000 times as long as wide", spindle(64, 2e6F),
                    Vec3(0.0F), 4.0F, 40.0F, true});
  // The middle is a point of the grid, and so are most of the origins, by whole numbers.
  meshes.push_back({"grid cube",
                    "corners on split planes, rays along planes with zeros among "
                    "their directions",
                    grid_cube(8), Vec3(4.0F), 3.0F, 16.0F});
  return meshes;
}

Ray ray_at_edge(const ClosedMesh& closed, const MeshScene& scene, Random& random) {
  const TriangleRecord& t = scene.records[random.below(scene.records.size())];
  const Vec3 target = t.a + random.uniform() * (t.b - t.a);
  for (;;) {
    const bool inside = random.below(2) == 0;
    Vec3 direction = random_direction(random);
    if (closed.level) direction = glm::normalize(Vec3(direction.x, 0.0F, direction.z));
    const float radius = inside ? closed.inner * random.uniform() : closed.outer;
    const Vec3 origin = closed.centre + radius * direction;
    if (target != origin) return make_ray(origin, glm::normalize(target - origin));
  }
}

std::vector<SurfaceMesh> surface_meshes() {
  std::vector<SurfaceMesh> sources;
  sources.push_back({"sphere", "angles down to 1e-6", moved_sphere(1.0F, 0.0F), true});
  sources.push_back({"moved sphere", "10,000 radii off", moved_sphere(1.0F, 1e4F), true});
  sources.push_back({"sphere moved far", "100,000 radii off", moved_sphere(1.0F, 1e5F), true});
  sources.push_back({"sphere moved farthest", "1,000,000 radii off: four bits are left",
                     moved_sphere(1.0F, 1e6F, 8, 12), true});
  sources.push_back({"tiny sphere", "scaled by 1e-6", moved_sphere(1e-6F, 0.0F), true});
  sources.push_back({"huge sphere", "scaled by 1e6", moved_sphere(1e6F, 0.0F), true});
  sources.push_back({"room on zero", "walls where coordinates are zero", grid_cube(4), true});
  sources.push_back({"large triangles at zero", "coordinates far smaller than their errors",
                     large_through_zero(1.0F), false});
  sources.push_back(
      {"huge triangles at zero", "the same scaled by 1e6", large_through_zero(1e6F), false});
  sources.push_back({"stadium", "0.1 units of detail on a floor of 20,000 that lies on zero",
                     teapot_in_stadium(0.1F, 1e4F), false});
  sources.push_back({"large stadium", "the same with a floor of 2,000,000",
                     teapot_in_stadium(0.1F, 1e6F), false});
  return sources;
}

Ray grazing_ray(const MeshScene& scene, Random& random) {
  for (;;) {
    const TriangleRecord& t = scene.records[random.below(scene.records.size())];
    const Vec3d a(t.a);
    const Vec3d e1 = Vec3d(t.b) - a;
    const Vec3d e2 = Vec3d(t.c) - a;
    const Vec3d normal = glm::cross(e1, e2);
    const double area = glm::length(normal);
    if (!(area > 0.0)) continue;
    const double u = random.below(4) == 0 ? 0.0 : double{random.uniform()};
    const double v = double{random.uniform()} * (1.0 - u);
    const Vec3d target = a + u * e1 + v * e2;
    const double turn = 6.28 * double{random.uniform()};
    const Vec3d along = glm::normalize(e1);
    const Vec3d across = glm::cross(normal / area, along);
    const double angle = std::pow(10.0, -6.0 * double{random.uniform()});
    const Vec3d direction =
        glm::normalize(std::cos(turn) * along + std::sin(turn) * across - angle * normal / area);
    const double distance = std::sqrt(area) * (0.1 + double{random.uniform()});
    return make_ray(Vec3(target - distance * direction), Vec3(direction));
  }
}

}  // namespace sheaf::stability
