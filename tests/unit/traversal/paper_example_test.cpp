// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// A tree and eight rays small enough to walk through on paper. In a box of 4 x 4 x 1, seen from
// above, with the triangles standing upright across x:
//
//   y=4 +-------------+--------------+
//       |     7       |        | T3  |      0: x = 2 -> 1 | 8
//   2.5 +-------------+        |     |      1: y = 2 -> 2 | 3       2: leaf T0
//       |  4: 5 | 6   |  10    |     |      3: y = 2.5 -> 4 | 7     7: empty leaf
//   y=2 +-------------+--------------+      4: z = 0.5 -> 5 | 6     5, 6: empty leaves
//       |   | T0      |  | T1    | T2|      8: y = 2 -> 9 | 10
//       |   |  2      |  |  9    |   |      9: leaf T1, T2          10: leaf T3
//   y=0 +-------------+--------------+
//      x=0    1       2  2.5   3   3.5  4
//
// What each ray visits alone: inner nodes; leaves; triangles tested.
//   0  (-1, 0.5, 0.25) along  x   0 1          2          T0            meets T0 at t = 2
//   1  (-1, 1.5, 0.1)  along  x   0 1          2          T0            meets T0 at t = 2
//   2  (-1, 1.9, 0.25) along  x   0 1 8        2 9        T0 T1 T2      passes over all three
//   3  (-1, 3, 0.25)   along  x   0 1 3 8      7 10       T3            meets T3 at t = 4
//   4  (5, 0.5, 0.25)  along -x   0 8          9          T1 T2         meets T2 at t = 1.5
//   5  (5, 3, 0.25)    along -x   0 8          10         T3            meets T3 at t = 2
//   6  (3.2, 3.5, 0.25) along -y  0 8          10 9       T3 T1 T2      meets nothing
//   7  like 0, a shadow ray       0 1          2          T0            is in shadow
// Together 19 inner nodes, 11 leaves and 13 tests, of 4 inner nodes and 4 triangles.

#include <gtest/gtest.h>

#include <set>

#include "test_mesh.h"

namespace sheaf::test {
namespace {

constexpr std::array<std::uint32_t, 8> kHits{0, 0, kNoHit, 3, 2, 3, kNoHit, 0};

TestScene hand_made() {
  Mesh mesh;
  const auto stand = [&](float x, float y) {
    mesh.add(Vec3(x, y, 0.0F), Vec3(x, y + 2.0F, 0.0F), Vec3(x, y, 1.0F));
  };
  stand(1.0F, 0.0F);
  stand(2.5F, 0.0F);
  stand(3.5F, 0.0F);
  stand(3.0F, 2.0F);
  TestScene scene(mesh);
  scene.tree.bounds = {Vec3(0.0F), Vec3(4.0F, 4.0F, 1.0F)};
  scene.tree.nodes = {
      KdNode::inner(0, 2.0F, 8), KdNode::inner(1, 2.0F, 3), KdNode::leaf(0, 1),
      KdNode::inner(1, 2.5F, 7), KdNode::inner(2, 0.5F, 6), KdNode::leaf(0, 0),
      KdNode::leaf(0, 0),        KdNode::leaf(0, 0),        KdNode::inner(1, 2.0F, 10),
      KdNode::leaf(1, 2),        KdNode::leaf(3, 1)};
  scene.tree.leaf_triangles = {0, 1, 2, 3};
  scene.tree.depth = 4;
  return scene;
}

RayPacket eight_rays() {
  RayPacket packet;
  packet.clear(8);
  const Vec3 forward(1.0F, 0.0F, 0.0F);
  const Vec3 backward(-1.0F, 0.0F, 0.0F);
  packet.put(0, make_ray(Vec3(-1.0F, 0.5F, 0.25F), forward));
  packet.put(1, make_ray(Vec3(-1.0F, 1.5F, 0.1F), forward));
  packet.put(2, make_ray(Vec3(-1.0F, 1.9F, 0.25F), forward));
  packet.put(3, make_ray(Vec3(-1.0F, 3.0F, 0.25F), forward));
  packet.put(4, make_ray(Vec3(5.0F, 0.5F, 0.25F), backward));
  packet.put(5, make_ray(Vec3(5.0F, 3.0F, 0.25F), backward));
  packet.put(6, make_ray(Vec3(3.2F, 3.5F, 0.25F), Vec3(0.0F, -1.0F, 0.0F)));
  Ray shadow = make_ray(Vec3(-1.0F, 0.5F, 0.25F), forward);
  shadow.tag.kind = RayKind::kShadow;
  packet.put(7, shadow);
  return packet;
}

using PerRay = std::array<std::uint32_t, 8>;
using Nodes = std::vector<std::uint32_t>;

struct Walk {
  explicit Walk(TraversalScheme scheme) : packet(eight_rays()) {
    trace_packet(scheme, scene.tree, scene.records, packet, &log, &lanes, counts);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(packet.hit_triangle[i], kHits[i]) << "ray " << i;
      inner_visits[i] = lanes.inner_visits[i];
      triangle_tests[i] = lanes.triangle_tests[i];
    }
    // One way or another, the measures are of the rays alone.
    EXPECT_EQ(counts.lane_inner_visits, 19U);
    EXPECT_EQ(counts.lane_leaf_visits, 11U);
    EXPECT_EQ(counts.lane_triangle_tests, 13U);
    for (const TraceStep& step : log) nodes.push_back(step.node);
  }
  TestScene scene = hand_made();
  RayPacket packet;
  TraceLog log;
  LaneCounts lanes;
  TraceCounts counts;
  PerRay inner_visits{};
  PerRay triangle_tests{};
  Nodes nodes;
};

TEST(PaperExample, SingleVisitsWhatEachRayVisitsAlone) {
  const Walk w(TraversalScheme::kSingle);
  EXPECT_EQ(w.inner_visits, (PerRay{2, 2, 3, 4, 2, 2, 2, 2}));
  EXPECT_EQ(w.triangle_tests, (PerRay{1, 1, 3, 1, 2, 1, 3, 1}));
  EXPECT_EQ(w.counts.packet_inner_visits, 19U);  // p_t = 1
  EXPECT_EQ(w.counts.packet_leaf_visits, 11U);
  EXPECT_EQ(w.counts.packet_triangle_tests, 13U);  // p_i = 1
  EXPECT_EQ(w.counts.passes, 8U);
  EXPECT_EQ(w.nodes, (Nodes{0, 1, 2,                      //
                            0, 1, 2,                      //
                            0, 1, 2,  8, 9,               //
                            0, 1, 3,  7, 8, 10, 0, 8, 9,  //
                            0, 8, 10,                     //
                            0, 8, 10, 9,                  //
                            0, 1, 2}));
  std::set<std::uint32_t> inner;
  std::set<std::uint32_t> tested;
  for (const TraceStep& step : w.log) {
    const KdNode node = w.scene.tree.nodes[step.node];
    if (!node.is_leaf()) inner.insert(step.node);
    for (std::uint32_t i = 0; i < step.num_tests; ++i) {
      tested.insert(w.scene.tree.leaf_triangles[node.first() + i]);
    }
  }
  EXPECT_EQ(inner.size(), 4U);   // c_t = 19 / 4
  EXPECT_EQ(tested.size(), 4U);  // c_i = 13 / 4
}

TEST(PaperExample, MaskedTakesThreePasses) {
  const Walk w(TraversalScheme::kMasked);
  EXPECT_EQ(w.inner_visits, (PerRay{2, 2, 3, 4, 2, 2, 2, 2}));
  EXPECT_EQ(w.triangle_tests, (PerRay{1, 1, 3, 1, 2, 1, 3, 1}));
  EXPECT_EQ(w.counts.packet_inner_visits, 8U);  // p_t = 19 / 8
  EXPECT_EQ(w.counts.packet_leaf_visits, 8U);
  EXPECT_EQ(w.counts.packet_triangle_tests, 10U);  // p_i = 13 / 10
  EXPECT_EQ(w.counts.passes, 3U);
  EXPECT_EQ(w.nodes, (Nodes{0, 1, 2, 3, 7, 8, 9, 10,  // rays 0 to 3 and 7
                            0, 8, 9, 10,              // 4 and 5
                            0, 8, 10, 9}));           // 6
}

// At node 0 five rays would begin on the left and two on the right, so that rays 4 and 5 see their
// far side first: 4 meets T0 there and yet must go on to T2.
TEST(PaperExample, OmniTakesOnePassAndSomeRaysTheirFarSideFirst) {
  const Walk w(TraversalScheme::kOmni);
  EXPECT_EQ(w.inner_visits, (PerRay{2, 2, 3, 4, 3, 4, 2, 2}));
  EXPECT_EQ(w.triangle_tests, (PerRay{1, 1, 3, 1, 3, 1, 3, 1}));
  EXPECT_EQ(w.counts.packet_inner_visits, 4U);  // p_t = 19 / 4
  EXPECT_EQ(w.counts.packet_leaf_visits, 4U);
  EXPECT_EQ(w.counts.packet_triangle_tests, 4U);  // p_i = 13 / 4
  EXPECT_EQ(w.counts.passes, 1U);
  EXPECT_EQ(w.nodes, (Nodes{0, 1, 2, 3, 7, 8, 10, 9}));
}

// The rays of the first pass start between y = 0.5 and 3, so that it also visits nodes 4 and 5,
// where none of them is.
TEST(PaperExample, IntervalAlsoVisitsWhatLiesBetweenItsRays) {
  const Walk w(TraversalScheme::kInterval);
  EXPECT_EQ(w.inner_visits, (PerRay{5, 5, 5, 5, 2, 2, 2, 5}));
  EXPECT_EQ(w.triangle_tests, (PerRay{1, 1, 3, 1, 2, 1, 3, 1}));
  EXPECT_EQ(w.counts.packet_inner_visits, 9U);  // p_t = 19 / 9
  EXPECT_EQ(w.counts.packet_leaf_visits, 9U);
  EXPECT_EQ(w.counts.packet_triangle_tests, 10U);  // p_i = 13 / 10
  EXPECT_EQ(w.counts.leaf_clips, 7U);
  EXPECT_EQ(w.counts.search_visits, 0U);
  EXPECT_EQ(w.counts.passes, 3U);
  EXPECT_EQ(w.nodes, (Nodes{0, 1, 2, 3, 4, 5, 7, 8, 9, 10,  //
                            0, 8, 9, 10,                    //
                            0, 8, 10, 9}));
}

// The first two passes divide at the root and find triangles on both sides of it; the third is on
// its right alone and begins at node 8.
TEST(PaperExample, IntervalEntryPaysForItsSearchAndBeginsBelow) {
  const Walk w(TraversalScheme::kIntervalEntry);
  EXPECT_EQ(w.inner_visits, (PerRay{8, 8, 8, 8, 5, 5, 3, 8}));
  EXPECT_EQ(w.triangle_tests, (PerRay{1, 1, 3, 1, 2, 1, 3, 1}));
  EXPECT_EQ(w.counts.packet_inner_visits, 16U);  // p_t = 19 / 16
  EXPECT_EQ(w.counts.search_visits, 8U);
  EXPECT_EQ(w.counts.packet_leaf_visits, 15U);
  EXPECT_EQ(w.counts.packet_triangle_tests, 10U);
  EXPECT_EQ(w.counts.leaf_clips, 7U);
  EXPECT_EQ(w.nodes, (Nodes{0, 1,  2,  8,  9,                  // search
                            0, 1,  2,  3,  4, 5, 7, 8, 9, 10,  //
                            0, 8,  9,  1,  2,                  // search
                            0, 8,  9,  10,                     //
                            0, 8,  10, 9,                      // search
                            8, 10, 9}));
}

// With 8 rays on 4 lanes a step of a whole packet takes 2 slots.
TEST(PaperExample, IntervalStepsTakeOneSlotAndClipsThoseOfThreeSteps) {
  const auto slots = [](TraversalScheme scheme) {
    const Walk w(scheme);
    std::uint32_t sum = 0;
    for (const TraceStep& step : w.log) sum += step_slots(scheme, step, 2);
    return sum;
  };
  EXPECT_EQ(slots(TraversalScheme::kSingle), 30U * 2);
  EXPECT_EQ(slots(TraversalScheme::kMasked), 16U * 2);
  EXPECT_EQ(slots(TraversalScheme::kOmni), 8U * 2);
  EXPECT_EQ(slots(TraversalScheme::kInterval), 11U + 7U * 6);
  EXPECT_EQ(slots(TraversalScheme::kIntervalEntry), 24U + 7U * 6);
}

}  // namespace
}  // namespace sheaf::test
