// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "test_mesh.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "geometry/watertight.h"
#include "kdtree/build.h"

namespace sheaf::test {

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

TestScene::TestScene(Mesh source)
    : mesh(std::move(source)), tree(build_kd_tree(mesh.positions, mesh.triangles)) {
  for (const auto& t : mesh.triangles) {
    records.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
  }
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

Ray make_ray(const Vec3& origin, const Vec3& direction) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.t_max = std::numeric_limits<float>::infinity();
  return ray;
}

Ray random_ray(Random& random, const Box& bounds) {
  const Vec3 origin = bounds.lo + bounds.extent() * (1.2F * random_point(random) - Vec3(0.1F));
  return make_ray(origin, random_direction(random));
}

RayPacket random_packet(Random& random, int size, const TestScene& scene) {
  RayPacket packet;
  packet.clear(size);
  const std::uint64_t filled = random.below(4) == 0 ? random.next() : ~std::uint64_t{0};
  const bool coherent = random.below(2) == 0;
  const Ray base = random_ray(random, scene.tree.bounds);
  for (int lane = 0; lane < size; ++lane) {
    Ray ray = random_ray(random, scene.tree.bounds);
    if (coherent) {
      ray.origin = base.origin;
      ray.direction = glm::normalize(base.direction + 0.1F * ray.direction);
    }
    if (random.below(3) == 0) {
      ray.tag.kind = RayKind::kShadow;
      ray.t_max = random.uniform();
    }
    if ((filled >> lane & 1U) != 0) packet.put(lane, ray);
  }
  return packet;
}

Hit trace_one(const TestScene& scene, const Ray& ray, TraversalScheme scheme) {
  const std::size_t lanes = scheme == TraversalScheme::kSingle ? 1 : 2;
  RayPacket packet;
  packet.clear(static_cast<int>(lanes));
  for (std::size_t lane = 0; lane < lanes; ++lane) packet.put(static_cast<int>(lane), ray);
  TraceCounts counts;
  trace_packet(scheme, scene.tree, scene.records, packet, nullptr, nullptr, counts);
  std::array<Hit, 2> hits;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if (packet.hit_triangle[lane] != kNoHit) {
      hits[lane] = {packet.hit_triangle[lane], packet.hit_t[lane]};
    }
  }
  if (lanes == 2 && hits[0] != hits[1]) throw std::logic_error("equal rays fare differently");
  return hits[0];
}

Hit test_all(const TestScene& scene, const Ray& ray) {
  const ShearedRay sheared(ray.origin, ray.direction);
  Hit best{kNoHit, ray.t_max};
  for (std::uint32_t i = 0; i < scene.records.size(); ++i) {
    TriangleHit hit;
    if (!hit_sheared(sheared.shear(&scene.records[i].a.x), hit)) continue;
    if (hit.t >= 0.0F && (hit.t < best.t || (hit.t == best.t && i < best.triangle))) {
      best = {i, hit.t};
    }
  }
  return best.triangle == kNoHit ? Hit{} : best;
}

}  // namespace sheaf::test
