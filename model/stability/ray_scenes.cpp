// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/ray_scenes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "stability/extreme_meshes.h"

namespace sheaf::stability {
namespace {

Mesh moved(Mesh mesh, float scale, float offset) {
  mesh.transform(scale, offset * Vec3(1.0F, -1.0F, 0.5F));
  return mesh;
}

/// For each triangle of a soup, one with the same longest edge, squeezed to a millionth of its
/// width: a needle if the third corner stays near an end, a sliver if it comes to lie in between.
Mesh squeezed(float third_corner, std::uint64_t seed) {
  const Mesh source = soup(150, 0.6F, seed);
  Mesh mesh;
  for (const auto& t : source.triangles) {
    const Vec3 a = source.positions[t[0]];
    const Vec3 b = source.positions[t[1]];
    const Vec3 c = source.positions[t[2]];
    mesh.add(a, b, a + third_corner * (b - a) + 1e-6F * (c - a));
  }
  return mesh;
}

/// Each triangle of a soup three times, and with each of them others without area: two corners
/// alike, all three alike, three on a line.
Mesh degenerate_and_duplicate() {
  Mesh mesh = soup(100, 0.5F, 48);
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = mesh.triangles[i];
    const Vec3 a = mesh.positions[t[0]];
    const Vec3 b = mesh.positions[t[1]];
    mesh.triangles.push_back(t);
    mesh.triangles.push_back({t[1], t[2], t[0]});
    mesh.triangles.push_back({t[0], t[0], t[1]});
    mesh.triangles.push_back({t[2], t[2], t[2]});
    mesh.add(a, b, 0.5F * (a + b));
  }
  return mesh;
}

Ray anywhere(const MeshScene& scene, Random& random) {
  return random_ray(random, scene.tree.bounds);
}

/// At a random point of a random edge, from anywhere around.
Ray at_an_edge(const MeshScene& scene, Random& random) {
  const Ray start = random_ray(random, scene.tree.bounds);
  const TriangleRecord& t = scene.records[random.below(scene.records.size())];
  const Vec3 to = t.a + random.uniform() * (t.b - t.a) - start.origin;
  return to == Vec3(0.0F) ? start : make_ray(start.origin, glm::normalize(to));
}

float whole_number(Random& random, int count) {
  return static_cast<float>(random.below(static_cast<std::uint64_t>(count)));
}

/// Between two points of a lattice of 4³ cells, or one of their neighbours.
Ray through_corners(const MeshScene& /*scene*/, Random& random) {
  for (;;) {
    const auto point = [&] {
      const float x = whole_number(random, 5);
      const float y = whole_number(random, 5);
      return Vec3(x, y, whole_number(random, 5));
    };
    const Vec3 from = point();
    const Vec3 to = point();
    if (from != to) return make_ray(from, glm::normalize(to - from));
  }
}

/// In a plane of the lattice, along it.
Ray in_a_wall(const MeshScene& /*scene*/, Random& random) {
  const auto axis = static_cast<int>(random.below(3));
  Vec3 origin = 4.0F * random_point(random);
  origin[axis] = whole_number(random, 5);
  Vec3 direction = random_direction(random);
  direction[axis] = random.below(2) == 0 ? 0.0F : -0.0F;
  return make_ray(origin, glm::normalize(direction));
}

/// From within 30 ulps of a split plane or, more often, a face of the box, along it or nearly so.
/// The traversal moves origins by about 12: where one comes to lie in the plane that it runs along,
/// the plane's distance is 0 times infinity.
Ray from_a_plane(const MeshScene& /*scene*/, Random& random) {
  const auto axis = static_cast<int>(random.below(3));
  Vec3 origin = 4.0F * random_point(random);
  const float ulps = whole_number(random, 61) - 30.0F;
  origin[axis] = (random.below(2) == 0 ? 4.0F : whole_number(random, 5)) + ulps * 0x1p-22F;
  Vec3 direction = random_direction(random);
  direction[axis] *= random.below(2) == 0 ? 0.0F : 1e-7F;
  return make_ray(origin, glm::normalize(direction));
}

/// Zeros of both signs, denormals and other numbers too small to matter beside ±1.
Ray odd_direction(const MeshScene& /*scene*/, Random& random) {
  constexpr std::array<float, 10> kOdd = {0.0F,    -0.0F,  1e-45F,  -1e-45F, 1e-40F,
                                          -1e-40F, 1e-30F, -1e-30F, 1e-7F,   -1e-7F};
  Vec3 origin = 4.0F * random_point(random);
  Vec3 direction;
  for (int axis = 0; axis < 3; ++axis) {
    if (random.below(2) == 0) origin[axis] = whole_number(random, 5);
    direction[axis] = kOdd[random.below(kOdd.size())];
  }
  direction[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1.0F : -1.0F;
  return make_ray(origin, direction);
}

/// From a hundred million times the scene's size away.
Ray from_far_away(const MeshScene& /*scene*/, Random& random) {
  const Vec3 direction = random_direction(random);
  return make_ray(random_point(random) - 1e8F * direction, direction);
}

/// At a corner, from so near to zero that the origin itself is off by next to nothing: what planes
/// are moved by must make up for the rounding of the triangle test alone.
Ray from_near_zero(const MeshScene& scene, Random& random) {
  const TriangleRecord& t = scene.records[random.below(scene.records.size())];
  const Vec3 origin = 1e-4F * random_point(random);
  return make_ray(origin, glm::normalize(t.a - origin));
}

/// At a corner, from anywhere around.
Ray at_a_corner(const MeshScene& scene, Random& random) {
  const Ray start = random_ray(random, scene.tree.bounds);
  const Vec3 to = scene.records[random.below(scene.records.size())].a - start.origin;
  return to == Vec3(0.0F) ? start : make_ray(start.origin, glm::normalize(to));
}

/// From the stands of the stadium at the teapot.
Ray across_the_stadium(const MeshScene& scene, Random& random) {
  const Vec3 extent = scene.tree.bounds.extent();
  const Vec3 share = random_point(random);
  const Vec3 origin = scene.tree.bounds.lo + extent * Vec3(share.x, 0.9F * share.y, share.z);
  const Vec3 target = Vec3(0.0F, 0.12F, 0.0F) + 0.12F * (random_point(random) - Vec3(0.5F));
  return make_ray(origin, glm::normalize(target - origin));
}

}  // namespace

std::vector<RayScene> ray_scenes() {
  return {
      {"moved by 1e4", "coordinates 10,000 times the scene's size",
       moved(soup(200, 0.3F, 44), 1.0F, 1e4F), anywhere},
      {"moved by 1e6", "coordinates 1,000,000 times the scene's size: four bits are left",
       moved(soup(200, 0.3F, 45), 1.0F, 1e6F), anywhere},
      {"scaled by 1e-6", "a scene of a micrometre", moved(soup(200, 0.3F, 46), 1e-6F, 0.0F),
       anywhere},
      {"scaled by 1e6", "a scene of a thousand kilometres", moved(soup(200, 0.3F, 47), 1e6F, 0.0F),
       anywhere},
      {"needles", "triangles 1,000,000 times as long as wide, sharp", squeezed(0.0F, 50),
       at_an_edge},
      {"slivers", "triangles 1,000,000 times as long as wide, blunt", squeezed(0.4F, 51),
       at_an_edge},
      {"degenerate and duplicate", "two thirds of the triangles are copies or have no area",
       degenerate_and_duplicate(), at_an_edge},
      {"coplanar walls", "rays within planes that hold triangles and split the tree", lattice(4),
       in_a_wall},
      {"shared edges and corners", "rays exactly from corner to corner", lattice(4),
       through_corners},
      {"origins on planes", "origins within 30 ulps of a split plane or a face of the box",
       lattice(4), from_a_plane},
      {"odd directions", "components ±0, denormal, or of 1e-45 to 1e-7 beside 1", lattice(4),
       odd_direction},
      {"far origins", "origins 1e8 times the scene's size away", soup(300, 0.3F, 52),
       from_far_away},
      {"origins near zero", "rays at corners, origins of a ten-thousandth of the scene's size",
       soup(300, 0.3F, 53), from_near_zero},
      {"corners moved by 1e4", "rays at corners, coordinates 10,000 times the scene's size",
       moved(soup(300, 0.3F, 54), 1.0F, 1e4F), at_a_corner},
      {"teapot in a stadium", "0.1 units of detail amid 10,000 units",
       teapot_in_stadium(0.1F, 1e4F), across_the_stadium},
  };
}

std::vector<RayScene> surface_ray_scenes() {
  std::vector<RayScene> scenes;
  for (ClosedMesh& closed : closed_meshes()) {
    Mesh mesh = closed.mesh;
    scenes.push_back({"at edges of " + closed.name, closed.extreme, std::move(mesh),
                      [closed = std::move(closed)](const MeshScene& scene, Random& random) {
                        return ray_at_edge(closed, scene, random);
                      }});
  }
  for (SurfaceMesh& surface : surface_meshes()) {
    scenes.push_back(
        {"grazing " + surface.name, surface.extreme, std::move(surface.mesh), grazing_ray});
  }
  return scenes;
}

}  // namespace sheaf::stability
