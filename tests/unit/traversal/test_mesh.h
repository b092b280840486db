// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kdtree/kd_tree.h"
#include "traversal/trace.h"

namespace sheaf::test {

/// Triangles to build scenes of.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  void add(const Vec3& a, const Vec3& b, const Vec3& c);
  /// The quadrilateral a, a + u, a + u + v, a + v as two triangles.
  void add_quad(const Vec3& a, const Vec3& u, const Vec3& v);
  /// Positions become scale × position + offset.
  void transform(float scale, const Vec3& offset);
};

/// Triangles of edge length about `size` strewn over the unit cube.
[[nodiscard]] Mesh soup(int count, float size, std::uint64_t seed);
/// A closed, star-shaped mesh around the origin of radius 1 ± `bump`, 2 × rings × sectors triangles
/// but for the poles. Every edge is shared by exactly two triangles.
[[nodiscard]] Mesh bumpy_sphere(int rings, int sectors, float bump);
/// The faces of n³ unit cells, all axis-aligned: every split plane holds triangles.
[[nodiscard]] Mesh lattice(int n);

/// A mesh with all that trace_packet() needs.
struct TestScene {
  explicit TestScene(Mesh source);
  Mesh mesh;
  KdTree tree;
  std::vector<TriangleRecord> records;
};

/// A point uniform in the unit cube, a direction uniform on the sphere.
[[nodiscard]] Vec3 random_point(Random& random);
[[nodiscard]] Vec3 random_direction(Random& random);
/// From anywhere in the slightly enlarged bounds into any direction.
[[nodiscard]] Ray random_ray(Random& random, const Box& bounds);
[[nodiscard]] Ray make_ray(const Vec3& origin, const Vec3& direction);
/// Rays of mixed directions, kinds and lengths in some lanes of a packet.
[[nodiscard]] RayPacket random_packet(Random& random, int size, const TestScene& scene);

struct Hit {
  std::uint32_t triangle = kNoHit;
  float t = 0.0F;
  bool operator==(const Hit&) const = default;
};
/// Traces one ray. All but kSingle trace it beside a copy of itself, for a lane left alone leaves
/// the vector kernel; throws std::logic_error if the two fare differently.
[[nodiscard]] Hit trace_one(const TestScene& scene, const Ray& ray,
                            TraversalScheme scheme = TraversalScheme::kSingle);
/// The same triangle test on every triangle: what a traversal that loses nothing must find.
[[nodiscard]] Hit test_all(const TestScene& scene, const Ray& ray);

}  // namespace sheaf::test
