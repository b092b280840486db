// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/mesh_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "geometry/watertight.h"

namespace sheaf::stability {

MeshScene::MeshScene(Mesh source, const KdBuildOptions& options)
    : mesh(std::move(source)), tree(build_kd_tree(mesh.positions, mesh.triangles, options)) {
  for (const auto& t : mesh.triangles) {
    records.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
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

std::string describe(const Ray& ray) {
  return fmt::format("origin ({:a}, {:a}, {:a}) direction ({:a}, {:a}, {:a})", ray.origin.x,
                     ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z);
}

RayPacket random_packet(Random& random, int size, const MeshScene& scene) {
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

namespace {

/// `lanes` copies of a ray.
RayPacket trace_copies(const MeshScene& scene, const Ray& ray, TraversalScheme scheme, int lanes,
                       TraceCounts& counts) {
  RayPacket packet;
  packet.clear(lanes);
  for (int lane = 0; lane < lanes; ++lane) packet.put(lane, ray);
  trace_packet(scheme, scene.tree, scene.records, packet, nullptr, nullptr, counts);
  return packet;
}

}  // namespace

Hit trace_one(const MeshScene& scene, const Ray& ray, TraversalScheme scheme) {
  const std::size_t lanes = scheme == TraversalScheme::kSingle ? 1 : 2;
  TraceCounts counts;
  const RayPacket packet = trace_copies(scene, ray, scheme, static_cast<int>(lanes), counts);
  std::array<Hit, 2> hits;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if (packet.hit_triangle[lane] != kNoHit) {
      hits[lane] = {packet.hit_triangle[lane], packet.hit_t[lane]};
    }
  }
  if (lanes == 2 && hits[0] != hits[1]) throw std::logic_error("equal rays fare differently");
  return hits[0];
}

bool masked_takes_steps_of_single(const MeshScene& scene, const Ray& ray) {
  TraceCounts single;
  TraceCounts masked;
  static_cast<void>(trace_copies(scene, ray, TraversalScheme::kSingle, 1, single));
  static_cast<void>(trace_copies(scene, ray, TraversalScheme::kMasked, 2, masked));
  return masked.lane_inner_visits == 2 * single.lane_inner_visits &&
         masked.lane_leaf_visits == 2 * single.lane_leaf_visits &&
         masked.lane_triangle_tests == 2 * single.lane_triangle_tests;
}

Hit test_all(const MeshScene& scene, const Ray& ray) {
  const ShearedRay sheared(ray.origin, ray.direction);
  Hit best{kNoHit, ray.t_max};
  for (std::uint32_t i = 0; i < scene.records.size(); ++i) {
    TriangleHit hit{};
    if (!hit_sheared(sheared.shear(&scene.records[i].a.x), hit)) continue;
    if (hit.t >= 0.0F && (hit.t < best.t || (hit.t == best.t && i < best.triangle))) {
      best = {i, hit.t};
    }
  }
  return best.triangle == kNoHit ? Hit{} : best;
}

}  // namespace sheaf::stability
