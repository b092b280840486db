// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Random scenes, trees and packets: all traversal schemes find what testing every triangle finds.
#include <gtest/gtest.h>

#include "generators.h"

namespace sheaf::stability {
namespace {

RC_GTEST_PROP(SchemesProperty, AllFindWhatTestingEveryTriangleFinds, ()) {
  const Mesh mesh = any_mesh();
  const MeshScene scene(mesh, any_tree());
  const Ray ray = any_ray();
  const Hit expected = test_all(scene, ray);
  for (const auto scheme : kTraversalSchemes) RC_ASSERT(trace_one(scene, ray, scheme) == expected);
}

RC_GTEST_PROP(SchemesProperty, ShadowRaysAreBlockedByAnythingBeforeTheirEnd, ()) {
  const Mesh mesh = any_mesh();
  const MeshScene scene(mesh, any_tree());
  Ray ray = any_ray();
  const Hit closest = test_all(scene, ray);
  const bool blocked = closest.triangle != kNoHit && closest.t < ray.t_max;
  ray.tag.kind = RayKind::kShadow;
  for (const auto scheme : kTraversalSchemes) {
    RC_ASSERT((trace_one(scene, ray, scheme).triangle != kNoHit) == blocked);
  }
}

RC_GTEST_PROP(SchemesProperty, ActiveLanesOfMaskedAreTheStepsOfSingleRays, ()) {
  const Mesh mesh = any_mesh();
  const MeshScene scene(mesh, any_tree());
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
