// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "meshes.h"

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace sheaf::test {
namespace {

Vec3 random_point(Random& random) {
  const float x = random.uniform();
  const float y = random.uniform();
  return {x, y, random.uniform()};
}

void add_box(Mesh& mesh, const Vec3& lo, const Vec3& hi) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const float side : {lo[axis], hi[axis]}) {
      Vec3 a = lo;
      a[axis] = side;
      Vec3 b = a;
      b[u] = hi[u];
      Vec3 c = b;
      c[v] = hi[v];
      Vec3 d = a;
      d[v] = hi[v];
      mesh.add(a, b, c);
      mesh.add(a, c, d);
    }
  }
}

}  // namespace

void Mesh::add(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  positions.insert(positions.end(), {a, b, c});
  triangles.push_back({first, first + 1, first + 2});
}

std::array<Vec3, 3> Mesh::corners(std::size_t triangle) const {
  const auto& index = triangles[triangle];
  return {positions[index[0]], positions[index[1]], positions[index[2]]};
}

Mesh random_soup(std::size_t count, float size) {
  Random random(11);
  Mesh mesh{.name = "soup", .positions = {}, .triangles = {}};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 center = random_point(random);
    const Vec3 a = center + size * random_point(random);
    const Vec3 b = center + size * random_point(random);
    mesh.add(a, b, center + size * random_point(random));
  }
  return mesh;
}

Mesh needles(std::size_t count) {
  Random random(12);
  Mesh mesh{.name = "needles", .positions = {}, .triangles = {}};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 a = random_point(random);
    const Vec3 b = random_point(random);
    mesh.add(a, b, a + 1e-6F * random_point(random));
  }
  return mesh;
}

Mesh sphere(std::size_t rings) {
  Mesh mesh{.name = "sphere", .positions = {}, .triangles = {}};
  const std::size_t columns = 2 * rings;
  for (std::size_t i = 0; i <= rings; ++i) {
    const double polar = std::numbers::pi * static_cast<double>(i) / static_cast<double>(rings);
    // All points of a pole are the same point, so that the sphere is closed.
    const double radius = i == 0 || i == rings ? 0.0 : std::sin(polar);
    for (std::size_t j = 0; j < columns; ++j) {
      const double turn =
          2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(columns);
      mesh.positions.emplace_back(radius * std::cos(turn), radius * std::sin(turn),
                                  std::cos(polar));
    }
  }
  const auto index = [columns](std::size_t i, std::size_t j) {
    return static_cast<std::uint32_t>(i * columns + j % columns);
  };
  for (std::size_t i = 0; i < rings; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      // The quads at the poles are triangles.
      if (i + 1 < rings) {
        mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      }
      if (i > 0) mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return mesh;
}

Mesh boxes_in_room(int boxes_per_side) {
  Random random(13);
  Mesh mesh{.name = "boxes", .positions = {}, .triangles = {}};
  const auto side = static_cast<float>(boxes_per_side);
  // No two extents are alike: planes of exactly equal cost would leave the tree to rounding.
  add_box(mesh, Vec3(0.0F), Vec3(1.1F * side, 1.0F * side, 7.3F));
  const auto step = [&random](std::uint64_t steps) {
    return 0.125F * static_cast<float>(random.below(steps));
  };
  for (int i = 0; i < boxes_per_side; ++i) {
    for (int j = 0; j < boxes_per_side; ++j) {
      const Vec3 corner(1.1F * static_cast<float>(i) + step(4), static_cast<float>(j) + step(4),
                        0.0F);
      const float width = 0.25F + step(3);
      add_box(mesh, corner, corner + Vec3(width, 0.25F + step(3), 1.0F + step(30)));
    }
  }
  return mesh;
}

Mesh flat_grid(int cells_per_side, float height) {
  Mesh mesh{.name = "flat", .positions = {}, .triangles = {}};
  const auto point = [&](int i, int j) {
    return Vec3(static_cast<float>(i), static_cast<float>(j), height);
  };
  for (int i = 0; i < cells_per_side; ++i) {
    for (int j = 0; j < cells_per_side; ++j) {
      mesh.add(point(i, j), point(i + 1, j), point(i + 1, j + 1));
      mesh.add(point(i, j), point(i + 1, j + 1), point(i, j + 1));
    }
  }
  return mesh;
}

Mesh transformed(Mesh mesh, float scale, float offset) {
  for (Vec3& position : mesh.positions) position = scale * position + offset;
  mesh.name += scale == 1.0F ? "_moved" : "_scaled";
  return mesh;
}

std::vector<Mesh> sample_meshes() {
  return {random_soup(1500, 0.1F),
          random_soup(300, 1.0F),
          needles(200),
          sphere(20),
          boxes_in_room(6),
          flat_grid(16, 0.0F),
          flat_grid(16, 3.7F),
          transformed(random_soup(800, 0.2F), 1e-6F, 0.0F),
          transformed(random_soup(800, 0.2F), 1e6F, 0.0F),
          transformed(random_soup(800, 0.2F), 100.0F, 1e6F),
          transformed(sphere(16), 1.0F, 1e4F)};
}

}  // namespace sheaf::test
