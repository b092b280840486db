// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "traversal/trace.h"

#include <gtest/gtest.h>

#include <limits>

#include "test_mesh.h"

namespace sheaf::test {
namespace {

/// A unit square at z = `z`, in the xy plane.
void add_wall(Mesh& mesh, float z) {
  mesh.add_quad(Vec3(0.0F, 0.0F, z), Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 1.0F, 0.0F));
}
const Vec3 kInside(0.6F, 0.3F, 0.0F);  // over the first triangle of a wall
const Vec3 kForward(0.0F, 0.0F, 1.0F);

TEST(Trace, HitCarriesDistanceAndWeightsOfSecondAndThirdCorner) {
  Mesh mesh;
  mesh.add(Vec3(0.0F, 0.0F, 2.0F), Vec3(1.0F, 0.0F, 2.0F), Vec3(0.0F, 1.0F, 2.0F));
  const TestScene scene(mesh);
  RayPacket packet;
  packet.clear(4);
  packet.put(2, make_ray(Vec3(0.5F, 0.25F, 0.0F), kForward));
  TraceCounts counts;
  trace_packet(TraversalScheme::kMasked, scene.tree, scene.records, packet, nullptr, nullptr,
               counts);
  EXPECT_EQ(packet.hit_triangle[2], 0U);
  EXPECT_EQ(packet.hit_t[2], 2.0F);
  EXPECT_EQ(packet.hit_u[2], 0.5F);
  EXPECT_EQ(packet.hit_v[2], 0.25F);
}

TEST(Trace, ClosestHitIncludesTMaxAndShadowRaysExcludeIt) {
  Mesh mesh;
  add_wall(mesh, 2.0F);
  const TestScene scene(mesh);
  for (const auto scheme : kTraversalSchemes) {
    Ray ray = make_ray(kInside, kForward);
    ray.t_max = 2.0F;
    EXPECT_EQ(trace_one(scene, ray, scheme).triangle, 0U);
    ray.tag.kind = RayKind::kShadow;
    EXPECT_EQ(trace_one(scene, ray, scheme).triangle, kNoHit);
    ray.t_max = std::nextafter(2.0F, 3.0F);
    EXPECT_EQ(trace_one(scene, ray, scheme).triangle, 0U);
    ray.tag.kind = RayKind::kPrimary;
    ray.t_max = std::nextafter(2.0F, 1.0F);
    EXPECT_EQ(trace_one(scene, ray, scheme).triangle, kNoHit);
  }
}

TEST(Trace, FindsTheSurfaceThatTheOriginLiesIn) {
  Mesh mesh;
  add_wall(mesh, 2.0F);
  const TestScene scene(mesh);
  const Ray ray = make_ray(kInside + 2.0F * kForward, kForward);
  EXPECT_EQ(trace_one(scene, ray, TraversalScheme::kSingle), (Hit{0, 0.0F}));
  EXPECT_EQ(trace_one(scene, ray, TraversalScheme::kMasked), (Hit{0, 0.0F}));
}

TEST(Trace, NothingBehindTheOriginIsHit) {
  Mesh mesh;
  add_wall(mesh, 1.0F);
  add_wall(mesh, 3.0F);
  const TestScene scene(mesh);
  for (const auto scheme : kTraversalSchemes) {
    const Ray between = make_ray(kInside + 2.0F * kForward, kForward);
    EXPECT_EQ(trace_one(scene, between, scheme).t, 1.0F);
    const Ray beyond = make_ray(kInside + 4.0F * kForward, kForward);
    EXPECT_EQ(trace_one(scene, beyond, scheme).triangle, kNoHit);
  }
}

TEST(Trace, EqualDistanceGoesToTheLowerPrimitive) {
  // Duplicates, and triangles in the same plane: whatever leaf comes first, the lower one wins.
  for (const bool reversed : {false, true}) {
    Mesh mesh;
    for (const float z : {3.0F, 2.0F, 2.0F, 5.0F, 2.0F}) add_wall(mesh, z);
    Mesh many = soup(200, 0.3F, 9);
    if (reversed) std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    const auto first = static_cast<std::uint32_t>(many.positions.size());
    many.positions.insert(many.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (auto t : mesh.triangles) {
      for (std::uint32_t& corner : t) corner += first;
      many.triangles.push_back(t);
      many.triangles.push_back(t);
    }
    const TestScene scene(many);
    Random random(10);
    for (int i = 0; i < 500; ++i) {
      const Vec3 to(random.uniform(), random.uniform(), 2.0F);
      const Vec3 from = random_point(random);
      const Ray ray = make_ray(from, glm::normalize(to - from));
      for (const auto scheme : kTraversalSchemes) {
        ASSERT_EQ(trace_one(scene, ray, scheme), test_all(scene, ray)) << "ray " << i;
      }
    }
  }
}

TEST(Trace, DegenerateTrianglesAreNeverHit) {
  Mesh mesh;
  const Vec3 p(0.5F, 0.5F, 1.0F);
  mesh.add(p, p, p);
  mesh.add(p, p, p + Vec3(1.0F, 0.0F, 0.0F));
  mesh.add(p, p + Vec3(1.0F, 0.0F, 0.0F), p + Vec3(2.0F, 0.0F, 0.0F));
  TestScene scene(mesh);
  // Whatever a builder leaves out: put all three into one leaf.
  scene.tree.nodes = {KdNode::leaf(0, 3)};
  scene.tree.leaf_triangles = {0, 1, 2};
  for (const float x : {0.5F, 0.75F, 1.5F, 2.5F}) {
    const Ray ray = make_ray(Vec3(x, 0.5F, 0.0F), kForward);
    EXPECT_EQ(trace_one(scene, ray).triangle, kNoHit);
    EXPECT_EQ(trace_one(scene, ray, TraversalScheme::kMasked).triangle, kNoHit);
  }
}

TEST(Trace, RaysThatAreNotFiniteMeetNothingAndVisitNothing) {
  const TestScene scene(soup(100, 0.5F, 11));
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  RayPacket packet;
  packet.clear(8);
  int lane = 0;
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    packet.put(lane++, make_ray(Vec3(bad, 0.5F, 0.5F), kForward));
    packet.put(lane++, make_ray(Vec3(0.5F), Vec3(0.0F, bad, 1.0F)));
  }
  Ray ray = make_ray(Vec3(0.5F), kForward);
  ray.t_max = kNan;
  packet.put(lane++, ray);
  for (const auto scheme : kTraversalSchemes) {
    TraceCounts counts;
    TraceLog log{{1, 2, 0}};
    trace_packet(scheme, scene.tree, scene.records, packet, &log, nullptr, counts);
    EXPECT_TRUE(log.empty());
    EXPECT_EQ(counts.lane_inner_visits + counts.lane_leaf_visits, 0U);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(packet.hit_triangle[i], kNoHit);
  }
}

TEST(Trace, EmptyPacketClearsTheLogAndCountsNothing) {
  const TestScene scene(soup(100, 0.5F, 11));
  RayPacket packet;
  packet.clear(16);
  TraceLog log{{1, 2, 0}};
  LaneCounts lanes;
  lanes.inner_visits[3] = 7;
  TraceCounts counts;
  trace_packet(TraversalScheme::kMasked, scene.tree, scene.records, packet, &log, &lanes, counts);
  EXPECT_TRUE(log.empty());
  EXPECT_EQ(lanes.inner_visits[3], 0U);
  EXPECT_EQ(counts, TraceCounts{});
}

TEST(Trace, CountsAccumulateOverPackets) {
  const TestScene scene(soup(100, 0.5F, 11));
  RayPacket packet;
  packet.clear(1);
  packet.put(0, make_ray(Vec3(-1.0F, 0.5F, 0.5F), Vec3(1.0F, 0.0F, 0.0F)));
  TraceCounts once;
  trace_packet(TraversalScheme::kMasked, scene.tree, scene.records, packet, nullptr, nullptr, once);
  EXPECT_GT(once.lane_inner_visits, 0U);
  EXPECT_EQ(once.passes, 1U);
  TraceCounts twice = once;
  trace_packet(TraversalScheme::kMasked, scene.tree, scene.records, packet, nullptr, nullptr,
               twice);
  once += once;
  EXPECT_EQ(twice, once);
}

}  // namespace
}  // namespace sheaf::test
