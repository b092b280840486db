// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/mesh.h"

#include <cmath>
#include <numbers>

namespace sheaf::stability {

void Mesh::add(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  positions.insert(positions.end(), {a, b, c});
  triangles.push_back({first, first + 1, first + 2});
}

void Mesh::add_quad(const Vec3& a, const Vec3& u, const Vec3& v) {
  add(a, a + u, a + u + v);
  add(a, a + u + v, a + v);
}

void Mesh::transform(float scale, const Vec3& offset) {
  for (Vec3& p : positions) p = scale * p + offset;
}

Mesh soup(int count, float size, std::uint64_t seed) {
  Random random(seed);
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 centre = random_point(random);
    const auto corner = [&] { return centre + size * (random_point(random) - Vec3(0.5F)); };
    const Vec3 a = corner();
    const Vec3 b = corner();
    mesh.add(a, b, corner());
  }
  return mesh;
}

Mesh bumpy_sphere(int rings, int sectors, float bump) {
  Mesh mesh;
  const auto pi = std::numbers::pi_v<double>;
  mesh.positions.emplace_back(0.0F, 1.0F, 0.0F);
  for (int ring = 1; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      const double theta = pi * ring / rings;
      const double phi = 2.0 * pi * sector / sectors;
      const double radius = 1.0 + double{bump} * std::sin(7.0 * theta) * std::cos(5.0 * phi);
      mesh.positions.emplace_back(radius * std::sin(theta) * std::cos(phi),
                                  radius * std::cos(theta),
                                  radius * std::sin(theta) * std::sin(phi));
    }
  }
  mesh.positions.emplace_back(0.0F, -1.0F, 0.0F);
  const auto south = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  const auto at = [&](int ring, int sector) {
    if (ring == 0) return std::uint32_t{0};
    if (ring == rings) return south;
    return static_cast<std::uint32_t>(1 + (ring - 1) * sectors + sector % sectors);
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      const std::uint32_t a = at(ring, sector);
      const std::uint32_t b = at(ring, sector + 1);
      const std::uint32_t c = at(ring + 1, sector);
      const std::uint32_t d = at(ring + 1, sector + 1);
      if (ring != rings - 1) mesh.triangles.push_back({a, c, d});
      if (ring != 0) mesh.triangles.push_back({a, d, b});
    }
  }
  // At the poles the triangle that is left has its corners (pole, c, d) or (a, c = d, b).
  return mesh;
}

Mesh lattice(int n) {
  Mesh mesh;
  const Vec3 x(1.0F, 0.0F, 0.0F);
  const Vec3 y(0.0F, 1.0F, 0.0F);
  const Vec3 z(0.0F, 0.0F, 1.0F);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      for (int k = 0; k <= n; ++k) {
        const Vec3 at(i, j, k);
        if (i < n && j < n) mesh.add_quad(at, x, y);
        if (j < n && k < n) mesh.add_quad(at, y, z);
        if (k < n && i < n) mesh.add_quad(at, z, x);
      }
    }
  }
  return mesh;
}

Mesh grid_cube(int cells) {
  Mesh mesh;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      for (const int side : {0, cells}) {
        for (int axis = 0; axis < 3; ++axis) {
          Vec3 at(0.0F);
          Vec3 u(0.0F);
          Vec3 v(0.0F);
          at[axis] = static_cast<float>(side);
          at[(axis + 1) % 3] = static_cast<float>(i);
          at[(axis + 2) % 3] = static_cast<float>(j);
          u[(axis + 1) % 3] = 1.0F;
          v[(axis + 2) % 3] = 1.0F;
          mesh.add_quad(at, u, v);
        }
      }
    }
  }
  return mesh;
}

Mesh spindle(int sectors, float aspect) {
  Mesh mesh;
  const float height = 0.5F * aspect;
  mesh.positions = {Vec3(0.0F, height, 0.0F), Vec3(0.0F, -height, 0.0F)};
  const double radius = 0.5 / std::sin(std::numbers::pi / sectors);
  for (int i = 0; i < sectors; ++i) {
    const double phi = 2.0 * std::numbers::pi * i / sectors;
    mesh.positions.emplace_back(radius * std::cos(phi), 0.0, radius * std::sin(phi));
  }
  for (int i = 0; i < sectors; ++i) {
    const auto here = static_cast<std::uint32_t>(2 + i);
    const auto next = static_cast<std::uint32_t>(2 + (i + 1) % sectors);
    mesh.triangles.push_back({0, next, here});
    mesh.triangles.push_back({1, here, next});
  }
  return mesh;
}

Mesh teapot_in_stadium(float size, float reach) {
  Mesh mesh = bumpy_sphere(24, 32, 0.1F);
  mesh.transform(size, Vec3(0.0F, 1.2F * size, 0.0F));
  mesh.add_quad(Vec3(-reach, 0.0F, -reach), Vec3(0.0F, 0.0F, 2.0F * reach),
                Vec3(2.0F * reach, 0.0F, 0.0F));
  // Stands that rise outwards on all four sides.
  const float rise = 0.3F * reach;
  for (int side = 0; side < 4; ++side) {
    const auto turned = [&](float x, float y, float z) {
      for (int i = 0; i < side; ++i) {
        const float was = x;
        x = -z;
        z = was;
      }
      return Vec3(x, y, z);
    };
    mesh.add_quad(turned(reach, 0.0F, -reach), turned(0.0F, 0.0F, 2.0F * reach),
                  turned(0.5F * reach, rise, 0.0F));
  }
  return mesh;
}

Vec3 random_point(Random& random) {
  const float x = random.uniform();
  const float y = random.uniform();
  return {x, y, random.uniform()};
}

Vec3 random_direction(Random& random) {
  for (;;) {
    const Vec3 p = 2.0F * random_point(random) - Vec3(1.0F);
    const float squared = glm::dot(p, p);
    if (squared > 0.01F && squared < 1.0F) return p / std::sqrt(squared);
  }
}

}  // namespace sheaf::stability
