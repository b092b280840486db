// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Masked traversal is single traversal, lane by lane.
#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "test_mesh.h"

namespace sheaf::test {
namespace {

struct Walk {
  RayPacket packet;
  TraceLog log;
  LaneCounts lanes;
  TraceCounts counts;
};

Walk walk(const TestScene& scene, TraversalScheme scheme, const RayPacket& packet) {
  Walk w;
  w.packet = packet;
  trace_packet(scheme, scene.tree, scene.records, w.packet, &w.log, &w.lanes, w.counts);
  return w;
}

void expect_same_hits(const RayPacket& a, const RayPacket& b) {
  for (LaneMask left = a.active; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    ASSERT_EQ(a.hit_triangle[lane], b.hit_triangle[lane]) << "lane " << lane;
    ASSERT_EQ(std::bit_cast<std::uint32_t>(a.hit_t[lane]),
              std::bit_cast<std::uint32_t>(b.hit_t[lane]));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(a.hit_u[lane]),
              std::bit_cast<std::uint32_t>(b.hit_u[lane]));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(a.hit_v[lane]),
              std::bit_cast<std::uint32_t>(b.hit_v[lane]));
  }
}

std::set<std::uint32_t> nodes_of(const TraceLog& log) {
  std::set<std::uint32_t> nodes;
  for (const TraceStep& step : log) nodes.insert(step.node);
  return nodes;
}

/// What the log must add up to.
void expect_log_matches_counts(const TestScene& scene, const Walk& w) {
  std::uint64_t inner = 0;
  std::uint64_t tests = 0;
  for (const TraceStep& step : w.log) {
    const KdNode node = scene.tree.nodes[step.node];
    inner += node.is_leaf() ? 0 : 1;
    tests += step.num_tests;
    ASSERT_LE(step.num_tests, node.is_leaf() ? node.count() : 0U);
  }
  ASSERT_EQ(inner, w.counts.packet_inner_visits);
  ASSERT_EQ(w.log.size() - inner, w.counts.packet_leaf_visits);
  ASSERT_EQ(tests, w.counts.packet_triangle_tests);
}

class MaskedTest : public testing::Test {
 protected:
  const TestScene soup_{soup(1500, 0.12F, 21)};
  const TestScene lattice_{lattice(4)};
  const TestScene sphere_{bumpy_sphere(24, 32, 0.1F)};
  const std::array<const TestScene*, 3> scenes_{&soup_, &lattice_, &sphere_};
};

TEST_F(MaskedTest, HitsAndLaneCountsEqualSingleAtEveryPacketSize) {
  Random random(22);
  for (int size = 1; size <= kMaxPacketSize; ++size) {
    for (int i = 0; i < 8; ++i) {
      const TestScene& scene = *scenes_[random.below(3)];
      const RayPacket packet = random_packet(random, size, scene);
      const Walk masked = walk(scene, TraversalScheme::kMasked, packet);
      const Walk single = walk(scene, TraversalScheme::kSingle, packet);
      ASSERT_NO_FATAL_FAILURE(expect_same_hits(masked.packet, single.packet)) << "size " << size;
      ASSERT_EQ(masked.counts.lane_inner_visits, single.counts.lane_inner_visits);
      ASSERT_EQ(masked.counts.lane_leaf_visits, single.counts.lane_leaf_visits);
      ASSERT_EQ(masked.counts.lane_triangle_tests, single.counts.lane_triangle_tests);
      ASSERT_EQ(masked.lanes.inner_visits, single.lanes.inner_visits);
      ASSERT_EQ(masked.lanes.triangle_tests, single.lanes.triangle_tests);
      ASSERT_LE(masked.counts.packet_inner_visits, single.counts.packet_inner_visits);
      ASSERT_EQ(nodes_of(masked.log), nodes_of(single.log));
      ASSERT_NO_FATAL_FAILURE(expect_log_matches_counts(scene, masked));
      ASSERT_NO_FATAL_FAILURE(expect_log_matches_counts(scene, single));
    }
  }
}

TEST_F(MaskedTest, ALaneFaresInAPacketAsAlone) {
  Random random(23);
  for (int i = 0; i < 60; ++i) {
    const TestScene& scene = *scenes_[random.below(3)];
    const RayPacket packet = random_packet(random, 16, scene);
    const Walk together = walk(scene, TraversalScheme::kMasked, packet);
    TraceLog one_by_one;
    for (LaneMask left = packet.active; left != 0; left &= left - 1) {
      RayPacket alone = packet;
      alone.active = left & (~left + 1);
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      const Walk w = walk(scene, TraversalScheme::kMasked, alone);
      ASSERT_NO_FATAL_FAILURE(expect_same_hits(w.packet, together.packet));
      ASSERT_EQ(w.lanes.inner_visits[lane], together.lanes.inner_visits[lane]);
      ASSERT_EQ(w.lanes.triangle_tests[lane], together.lanes.triangle_tests[lane]);
      one_by_one.insert(one_by_one.end(), w.log.begin(), w.log.end());
    }
    // The single scheme walks lane after lane, step by step the same.
    const Walk single = walk(scene, TraversalScheme::kSingle, packet);
    ASSERT_EQ(single.log.size(), one_by_one.size());
    for (std::size_t k = 0; k < one_by_one.size(); ++k) {
      ASSERT_EQ(single.log[k].node, one_by_one[k].node);
      ASSERT_EQ(single.log[k].num_tests, one_by_one[k].num_tests);
    }
  }
}

// Where the origin, moved by the error bound, meets a plane that the ray runs along, the distance
// to the plane is 0 · infinity, and every kernel must make the same of it: both sides count.
TEST_F(MaskedTest, DistancesThatAreNotNumbersAreTakenAlike) {
  Random random(26);
  for (int plane = 0; plane <= 4; ++plane) {
    for (int ulps = -100; ulps <= 100; ++ulps) {
      for (const float zero : {0.0F, -0.0F}) {
        const auto axis = static_cast<int>(random.below(3));
        Ray ray = random_ray(random, lattice_.tree.bounds);
        ray.origin[axis] = static_cast<float>(plane) + static_cast<float>(ulps) * 0x1p-23F;
        ray.direction[axis] = zero;
        RayPacket packet;
        packet.clear(2);  // two, for one alone would leave the vector kernel
        packet.put(0, ray);
        packet.put(1, ray);
        const Walk masked = walk(lattice_, TraversalScheme::kMasked, packet);
        const Walk single = walk(lattice_, TraversalScheme::kSingle, packet);
        ASSERT_NO_FATAL_FAILURE(expect_same_hits(masked.packet, single.packet));
        ASSERT_EQ(masked.lanes.inner_visits, single.lanes.inner_visits);
        ASSERT_EQ(masked.lanes.triangle_tests, single.lanes.triangle_tests);
      }
    }
  }
}

TEST_F(MaskedTest, WhatIsRecordedDoesNotChangeWhatIsFound) {
  Random random(24);
  for (int i = 0; i < 60; ++i) {
    const TestScene& scene = *scenes_[random.below(3)];
    const RayPacket packet = random_packet(random, 32, scene);
    const Walk recorded = walk(scene, TraversalScheme::kMasked, packet);
    for (const bool log : {false, true}) {
      Walk w;
      w.packet = packet;
      trace_packet(TraversalScheme::kMasked, scene.tree, scene.records, w.packet,
                   log ? &w.log : nullptr, log ? nullptr : &w.lanes, w.counts);
      ASSERT_NO_FATAL_FAILURE(expect_same_hits(w.packet, recorded.packet));
      ASSERT_EQ(w.counts, recorded.counts);
    }
    Walk plain;
    plain.packet = packet;
    trace_packet(TraversalScheme::kMasked, scene.tree, scene.records, plain.packet, nullptr,
                 nullptr, plain.counts);
    ASSERT_NO_FATAL_FAILURE(expect_same_hits(plain.packet, recorded.packet));
    ASSERT_EQ(plain.counts, recorded.counts);
  }
}

TEST_F(MaskedTest, OnePassForEachDirectionSignConfiguration) {
  RayPacket packet;
  packet.clear(16);
  for (int lane = 0; lane < 16; ++lane) {
    const auto sign = [&](int bit) { return (lane >> bit & 1) != 0 ? -0.6F : 0.6F; };
    packet.put(lane, make_ray(Vec3(0.5F), Vec3(sign(0), sign(1), sign(2))));
  }
  EXPECT_EQ(walk(soup_, TraversalScheme::kMasked, packet).counts.passes, 8U);
  EXPECT_EQ(walk(soup_, TraversalScheme::kSingle, packet).counts.passes, 16U);
  packet.active = 0b1000'0001;
  EXPECT_EQ(walk(soup_, TraversalScheme::kMasked, packet).counts.passes, 2U);
  // The sign of a zero is its sign bit.
  packet.clear(2);
  packet.put(0, make_ray(Vec3(0.5F), Vec3(0.0F, 0.0F, 1.0F)));
  packet.put(1, make_ray(Vec3(0.5F), Vec3(-0.0F, 0.0F, 1.0F)));
  EXPECT_EQ(walk(soup_, TraversalScheme::kMasked, packet).counts.passes, 2U);
}

TEST_F(MaskedTest, PassesComeInAscendingOrderOfTheirSignCode) {
  RayPacket packet;
  packet.clear(2);
  packet.put(0, make_ray(Vec3(0.5F, 0.5F, 2.0F), Vec3(0.0F, 0.0F, -1.0F)));  // code 4
  packet.put(1, make_ray(Vec3(2.0F, 0.5F, 0.5F), Vec3(-1.0F, 0.0F, 0.0F)));  // code 1
  const Walk both = walk(soup_, TraversalScheme::kMasked, packet);
  packet.active = 0b10;
  const Walk first = walk(soup_, TraversalScheme::kMasked, packet);
  ASSERT_FALSE(first.log.empty());
  ASSERT_LT(first.log.size(), both.log.size());
  for (std::size_t i = 0; i < first.log.size(); ++i) {
    EXPECT_EQ(both.log[i].node, first.log[i].node);
  }
}

TEST_F(MaskedTest, PacketOfShadowRaysStopsInTheMiddleOfALeaf) {
  Mesh mesh;
  for (int i = 0; i < 10; ++i) {
    mesh.add_quad(Vec3(0.0F, 0.0F, 1.0F + static_cast<float>(i)), Vec3(1.0F, 0.0F, 0.0F),
                  Vec3(0.0F, 1.0F, 0.0F));
  }
  TestScene scene(mesh);
  scene.tree.nodes = {KdNode::leaf(0, 20)};
  scene.tree.leaf_triangles.resize(20);
  for (std::uint32_t i = 0; i < 20; ++i) scene.tree.leaf_triangles[i] = i;
  RayPacket packet;
  packet.clear(4);
  Ray ray = make_ray(Vec3(0.6F, 0.3F, 0.0F), Vec3(0.0F, 0.0F, 1.0F));
  ray.tag.kind = RayKind::kShadow;
  packet.put(0, ray);
  ray.origin = Vec3(0.3F, 0.6F, 1.5F);
  packet.put(1, ray);
  const Walk w = walk(scene, TraversalScheme::kMasked, packet);
  ASSERT_EQ(w.log.size(), 1U);
  EXPECT_EQ(w.log[0].num_tests, 4U);  // lane 0 ends with triangle 0, lane 1 with triangle 3
  EXPECT_EQ(w.lanes.triangle_tests[0], 1U);
  EXPECT_EQ(w.lanes.triangle_tests[1], 4U);
  EXPECT_EQ(w.counts.lane_triangle_tests, 5U);
}

/// A split at x = 0.5 with a leaf on either side.
TestScene one_split() {
  Mesh mesh;
  mesh.add_quad(Vec3(0.0F), Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 1.0F, 0.0F));
  TestScene scene(mesh);
  scene.tree.nodes = {KdNode::inner(0, 0.5F, 2), KdNode::leaf(0, 0), KdNode::leaf(0, 0)};
  scene.tree.leaf_triangles.clear();
  return scene;
}

/// Leaves that a ray visits, which must be as many alone as beside its like.
std::uint64_t leaf_visits(const TestScene& scene, const Ray& ray) {
  RayPacket packet;
  packet.clear(2);
  packet.put(0, ray);
  const Walk alone = walk(scene, TraversalScheme::kSingle, packet);
  packet.put(1, ray);
  const Walk both = walk(scene, TraversalScheme::kMasked, packet);
  EXPECT_EQ(2 * alone.counts.lane_leaf_visits, both.counts.lane_leaf_visits);
  return alone.counts.lane_leaf_visits;
}

TEST(MaskedBoundary, FarChildIsVisitedToTheVeryUlpAlone) {
  const TestScene scene = one_split();
  std::set<std::uint64_t> visits;
  Ray ray = make_ray(Vec3(-1.0F, 0.5F, 0.0F), Vec3(1.0F, 0.0F, 0.0F));
  const auto crossing = std::bit_cast<std::uint32_t>(1.5F);
  for (std::uint32_t bits = crossing - 64; bits <= crossing + 64; ++bits) {
    ray.t_max = std::bit_cast<float>(bits);
    visits.insert(leaf_visits(scene, ray));
  }
  EXPECT_EQ(visits, (std::set<std::uint64_t>{1, 2}));
}

TEST(MaskedBoundary, NearChildIsVisitedToTheVeryUlpAlone) {
  const TestScene scene = one_split();
  std::set<std::uint64_t> visits;
  const auto split = std::bit_cast<std::uint32_t>(0.5F);
  for (std::uint32_t bits = split - 64; bits <= split + 64; ++bits) {
    const Vec3 origin(std::bit_cast<float>(bits), 0.5F, 0.0F);
    visits.insert(leaf_visits(scene, make_ray(origin, Vec3(1.0F, 0.0F, 0.0F))));
  }
  EXPECT_EQ(visits, (std::set<std::uint64_t>{1, 2}));
}

}  // namespace
}  // namespace sheaf::test
