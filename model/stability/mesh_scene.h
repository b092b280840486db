// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kdtree/build.h"
#include "stability/mesh.h"
#include "traversal/trace.h"

namespace sheaf::stability {

/// A mesh with all that trace_packet() needs.
struct MeshScene {
  explicit MeshScene(Mesh source, const KdBuildOptions& options = {});
  Mesh mesh;
  KdTree tree;
  std::vector<TriangleRecord> records;
};

/// From anywhere in the slightly enlarged bounds into any direction.
[[nodiscard]] Ray random_ray(Random& random, const Box& bounds);
[[nodiscard]] Ray make_ray(const Vec3& origin, const Vec3& direction);
/// Origin and direction in hexadecimal, which reads back exactly.
[[nodiscard]] std::string describe(const Ray& ray);
/// Rays of mixed directions, kinds and lengths in some lanes of a packet.
[[nodiscard]] RayPacket random_packet(Random& random, int size, const MeshScene& scene);

struct Hit {
  std::uint32_t triangle = kNoHit;
  float t = 0.0F;
  bool operator==(const Hit&) const = default;
};
/// Traces one ray. All but kSingle trace it beside a copy of itself, for a lane left alone leaves
/// the vector kernel; throws std::logic_error if the two fare differently.
[[nodiscard]] Hit trace_one(const MeshScene& scene, const Ray& ray,
                            TraversalScheme scheme = TraversalScheme::kSingle);
/// Whether two copies of a ray, side by side, take the steps that the ray takes alone, each of
/// them.
[[nodiscard]] bool masked_takes_steps_of_single(const MeshScene& scene, const Ray& ray);
/// The same triangle test on every triangle: what a traversal that loses nothing must find.
[[nodiscard]] Hit test_all(const MeshScene& scene, const Ray& ray);

}  // namespace sheaf::stability
