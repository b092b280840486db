// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "geometry/vec.h"

namespace sheaf::stability {

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
/// A closed cube of `cells` × `cells` squares a face, from the origin to (cells, cells, cells): all
/// corners and split planes at whole numbers.
[[nodiscard]] Mesh grid_cube(int cells);
/// A closed fan of needles: two apexes on the y axis, `aspect` apart, over a ring of unit edges, so
/// that triangles are half of `aspect` times as long as wide. Shares every edge.
[[nodiscard]] Mesh spindle(int sectors, float aspect);
/// A small bumpy body of radius `size` above the ground in the middle of a field of half width
/// `reach` with a stand on each side: the "teapot in a stadium".
[[nodiscard]] Mesh teapot_in_stadium(float size, float reach);

/// A point uniform in the unit cube, a direction uniform on the sphere.
[[nodiscard]] Vec3 random_point(Random& random);
[[nodiscard]] Vec3 random_direction(Random& random);

}  // namespace sheaf::stability
