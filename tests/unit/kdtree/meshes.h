// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/vec.h"

namespace sheaf::test {

struct Mesh {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  void add(const Vec3& a, const Vec3& b, const Vec3& c);
  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t triangle) const;
};

/// Small triangles with edges up to `size`, anywhere in the unit cube.
[[nodiscard]] Mesh random_soup(std::size_t count, float size);
/// Needles and slivers, 1 long and 1e-6 wide, in all directions.
[[nodiscard]] Mesh needles(std::size_t count);
/// A closed sphere of rings × 2·rings quads (triangles at the poles).
[[nodiscard]] Mesh sphere(std::size_t rings);
/// A room with axis-aligned boxes on its floor, so that many walls are coplanar.
[[nodiscard]] Mesh boxes_in_room(int boxes_per_side);
/// A flat, tessellated square in the plane z = height.
[[nodiscard]] Mesh flat_grid(int cells_per_side, float height);
/// The same mesh with every position multiplied, then moved.
[[nodiscard]] Mesh transformed(Mesh mesh, float scale, float offset);

/// One of each kind, small enough for slow oracles.
[[nodiscard]] std::vector<Mesh> sample_meshes();

}  // namespace sheaf::test
