// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Random scenes and packets: all traversal schemes find what testing every triangle finds.
// RapidCheck prints the seed of a failure and shrinks it; RC_PARAMS="seed=…" repeats it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "stability/mesh_scene.h"

namespace sheaf::stability {
namespace {

/// Coordinates that meet often: multiples of 1/4, so that triangles share planes, edges and
/// corners.
Vec3 any_point() {
  const auto coordinate = [] { return 0.25F * static_cast<float>(*rc::gen::inRange(-8, 9)); };
  const float x = coordinate();
  const float y = coordinate();
  return {x, y, coordinate()};
}

Mesh any_mesh() {
  Mesh mesh;
  const int count = *rc::gen::inRange(1, 40);
  for (int i = 0; i < count; ++i) {
    const Vec3 a = any_point();
    const Vec3 b = any_point();
    mesh.add(a, b, any_point());
  }
  return mesh;
}

Ray any_ray() {
  const Vec3 from = any_point();
  const Vec3 to = any_point();
  return make_ray(from, from == to ? Vec3(0.0F, 0.0F, 1.0F) : glm::normalize(to - from));
}

RC_GTEST_PROP(SchemesProperty, AllFindWhatTestingEveryTriangleFinds, ()) {
  const MeshScene scene(any_mesh());
  const Ray ray = any_ray();
  const Hit expected = test_all(scene, ray);
  for (const auto scheme : kTraversalSchemes) RC_ASSERT(trace_one(scene, ray, scheme) == expected);
}

RC_GTEST_PROP(SchemesProperty, ActiveLanesOfMaskedAreTheStepsOfSingleRays, ()) {
  const MeshScene scene(any_mesh());
  RayPacket packet;
  const int size = *rc::gen::inRange(1, 65);
  packet.clear(size);
  for (int lane = 0; lane < size; ++lane) {
    if (*rc::gen::arbitrary<bool>()) packet.put(lane, any_ray());
  }
  TraceCounts single;
  TraceCounts masked;
  RayPacket copy = packet;
  trace_packet(TraversalScheme::kSingle, scene.tree, scene.records, copy, nullptr, nullptr, single);
  trace_packet(TraversalScheme::kMasked, scene.tree, scene.records, packet, nullptr, nullptr,
               masked);
  RC_ASSERT(single.lane_inner_visits == masked.lane_inner_visits);
  RC_ASSERT(single.lane_leaf_visits == masked.lane_leaf_visits);
  RC_ASSERT(single.lane_triangle_tests == masked.lane_triangle_tests);
}

}  // namespace
}  // namespace sheaf::stability
