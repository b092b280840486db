// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Interval and omnidirectional traversal against single rays and masked packets.
#include <gtest/gtest.h>

#include <bit>

#include "test_mesh.h"
#include "traversal/interval_bounds.h"

namespace sheaf::test {
namespace {

struct Walk {
  Walk(const TestScene& scene, TraversalScheme scheme, const RayPacket& rays) : packet(rays) {
    trace_packet(scheme, scene.tree, scene.records, packet, &log, &lanes, counts);
  }
  RayPacket packet;
  TraceLog log;
  LaneCounts lanes;
  TraceCounts counts;
};

constexpr std::array kIntervalSchemes{TraversalScheme::kInterval, TraversalScheme::kIntervalEntry};

/// What every scheme must find. Which triangle ends a shadow ray may depend on the order of visits.
void expect_same_hits(const RayPacket& a, const RayPacket& b) {
  for (LaneMask left = a.active; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    ASSERT_EQ(a.hit_triangle[lane] == kNoHit, b.hit_triangle[lane] == kNoHit) << "lane " << lane;
    if (((a.any_hit >> lane) & 1U) != 0) continue;
    ASSERT_EQ(a.hit_triangle[lane], b.hit_triangle[lane]) << "lane " << lane;
    for (const auto values : {&RayPacket::hit_t, &RayPacket::hit_u, &RayPacket::hit_v}) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>((a.*values)[lane]),
                std::bit_cast<std::uint32_t>((b.*values)[lane]));
    }
  }
}

void expect_log_matches_counts(const TestScene& scene, const Walk& w) {
  std::uint64_t inner = 0;
  std::uint64_t tests = 0;
  std::uint64_t clips = 0;
  for (const TraceStep& step : w.log) {
    const KdNode node = scene.tree.nodes[step.node];
    inner += node.is_leaf() ? 0 : 1;
    tests += step.num_tests;
    clips += step.clips;
    ASSERT_LE(step.num_tests, node.is_leaf() ? node.count() : 0U);
    ASSERT_TRUE(step.clips == 0 || (node.is_leaf() && node.count() != 0));
  }
  ASSERT_EQ(inner, w.counts.packet_inner_visits);
  ASSERT_EQ(w.log.size() - inner, w.counts.packet_leaf_visits);
  ASSERT_EQ(tests, w.counts.packet_triangle_tests);
  ASSERT_EQ(clips, w.counts.leaf_clips);
}

void expect_same_alone(const TraceCounts& a, const TraceCounts& b) {
  ASSERT_EQ(a.lane_inner_visits, b.lane_inner_visits);
  ASSERT_EQ(a.lane_leaf_visits, b.lane_leaf_visits);
  ASSERT_EQ(a.lane_triangle_tests, b.lane_triangle_tests);
}

class SchemesTest : public testing::Test {
 protected:
  /// Calls check(scene, packet) with packets of every size and of all sorts.
  template <class Check>
  void for_many_packets(std::uint64_t seed, const Check& check) {
    Random random(seed);
    for (int size = 1; size <= kMaxPacketSize; ++size) {
      for (int i = 0; i < 8; ++i) {
        const TestScene& scene = *scenes_[random.below(3)];
        ASSERT_NO_FATAL_FAILURE(check(scene, random_packet(random, size, scene)))
            << "size " << size << ", packet " << i;
      }
    }
  }

  const TestScene soup_{soup(1500, 0.12F, 61)};
  const TestScene lattice_{lattice(4)};
  const TestScene sphere_{bumpy_sphere(24, 32, 0.1F)};
  const std::array<const TestScene*, 3> scenes_{&soup_, &lattice_, &sphere_};
};

TEST_F(SchemesTest, AllFindTheSameHitsAndCountTheSameForRaysAlone) {
  for_many_packets(62, [](const TestScene& scene, const RayPacket& packet) {
    const Walk single(scene, TraversalScheme::kSingle, packet);
    for (const TraversalScheme scheme : kTraversalSchemes) {
      const Walk w(scene, scheme, packet);
      ASSERT_NO_FATAL_FAILURE(expect_same_hits(w.packet, single.packet));
      ASSERT_NO_FATAL_FAILURE(expect_same_alone(w.counts, single.counts));
      ASSERT_NO_FATAL_FAILURE(expect_log_matches_counts(scene, w));
    }
  });
}

TEST_F(SchemesTest, IntervalTakesNoRayToFewerNodesThanItVisitsAlone) {
  std::uint64_t more = 0;
  for_many_packets(63, [&](const TestScene& scene, const RayPacket& packet) {
    const Walk single(scene, TraversalScheme::kSingle, packet);
    for (const TraversalScheme scheme : kIntervalSchemes) {
      const Walk w(scene, scheme, packet);
      for (std::size_t lane = 0; lane < kMaxPacketSize; ++lane) {
        ASSERT_GE(w.lanes.inner_visits[lane], single.lanes.inner_visits[lane]);
        more += w.lanes.inner_visits[lane] - single.lanes.inner_visits[lane];
      }
    }
  });
  EXPECT_GT(more, 0U);
}

// The leaf's box clips a ray as the planes on the way to the leaf would have done one by one.
TEST_F(SchemesTest, IntervalTestsTheSameTrianglesWithTheSameRaysAsMasked) {
  for_many_packets(64, [](const TestScene& scene, const RayPacket& packet) {
    const Walk masked(scene, TraversalScheme::kMasked, packet);
    for (const TraversalScheme scheme : kIntervalSchemes) {
      const Walk w(scene, scheme, packet);
      ASSERT_EQ(w.lanes.triangle_tests, masked.lanes.triangle_tests);
      ASSERT_EQ(w.counts.packet_triangle_tests, masked.counts.packet_triangle_tests);
      ASSERT_GE(w.counts.packet_inner_visits, masked.counts.packet_inner_visits);
      ASSERT_EQ(w.counts.passes, masked.counts.passes);
      // Also which hit ends a shadow ray.
      for (LaneMask left = packet.active; left != 0; left &= left - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(left));
        ASSERT_EQ(w.packet.hit_triangle[lane], masked.packet.hit_triangle[lane]);
      }
    }
  });
}

TEST_F(SchemesTest, IntervalFromAnEntryPointWalksAPartOfWhatItWalksFromTheRoot) {
  std::uint64_t saved = 0;
  for_many_packets(65, [&](const TestScene& scene, const RayPacket& packet) {
    const Walk root(scene, TraversalScheme::kInterval, packet);
    const Walk entry(scene, TraversalScheme::kIntervalEntry, packet);
    const std::uint64_t walked = entry.counts.packet_inner_visits - entry.counts.search_visits;
    ASSERT_LE(walked, root.counts.packet_inner_visits);
    ASSERT_EQ(entry.counts.leaf_clips, root.counts.leaf_clips);
    saved += root.counts.packet_inner_visits - walked;
  });
  EXPECT_GT(saved, 0U);
}

TEST_F(SchemesTest, OmniWalksRaysOfOneOctantAsMaskedDoes) {
  for_many_packets(66, [](const TestScene& scene, RayPacket packet) {
    for (auto& component : packet.direction) {
      for (float& d : component) d = std::abs(d);
    }
    const Walk masked(scene, TraversalScheme::kMasked, packet);
    const Walk omni(scene, TraversalScheme::kOmni, packet);
    ASSERT_EQ(omni.log.size(), masked.log.size());
    for (std::size_t i = 0; i < omni.log.size(); ++i) {
      ASSERT_EQ(omni.log[i].node, masked.log[i].node);
      ASSERT_EQ(omni.log[i].num_tests, masked.log[i].num_tests);
    }
    ASSERT_EQ(omni.lanes.inner_visits, masked.lanes.inner_visits);
  });
}

TEST_F(SchemesTest, OmniTakesOnePassAndFewerStepsThanOneAnOctant) {
  std::uint64_t omni_steps = 0;
  std::uint64_t masked_steps = 0;
  for_many_packets(67, [&](const TestScene& scene, const RayPacket& packet) {
    const Walk omni(scene, TraversalScheme::kOmni, packet);
    ASSERT_EQ(omni.counts.passes, packet.active != 0 ? 1U : 0U);
    omni_steps += omni.counts.packet_inner_visits;
    masked_steps += Walk(scene, TraversalScheme::kMasked, packet).counts.packet_inner_visits;
  });
  EXPECT_LT(omni_steps, masked_steps);
}

// Where a ray runs in a plane its distance to it is 0 · infinity: both sides count, for all.
TEST_F(SchemesTest, DistancesThatAreNotNumbersLoseNoHit) {
  Random random(68);
  for (int plane = 0; plane <= 4; ++plane) {
    for (int ulps = -60; ulps <= 60; ++ulps) {
      RayPacket packet;
      packet.clear(4);
      const auto axis = static_cast<int>(random.below(3));
      for (int lane = 0; lane < 4; ++lane) {
        Ray ray = random_ray(random, lattice_.tree.bounds);
        ray.origin[axis] = static_cast<float>(plane) + static_cast<float>(ulps) * 0x1p-23F;
        ray.direction[axis] = lane % 2 == 0 ? 0.0F : -0.0F;
        packet.put(lane, ray);
      }
      const Walk single(lattice_, TraversalScheme::kSingle, packet);
      for (const TraversalScheme scheme : kTraversalSchemes) {
        const Walk w(lattice_, scheme, packet);
        ASSERT_NO_FATAL_FAILURE(expect_same_hits(w.packet, single.packet));
        ASSERT_NO_FATAL_FAILURE(expect_same_alone(w.counts, single.counts));
      }
    }
  }
}

TEST(Product, HoldsEveryProductOfItsRangesAndIsAnythingWhereOneIsNoNumber) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto is = [](const Range& range, float lo, float hi) {
    EXPECT_EQ(range.lo, lo);
    EXPECT_EQ(range.hi, hi);
  };
  is(product({1.0F, 2.0F}, {3.0F, 5.0F}), 3.0F, 10.0F);
  is(product({-1.0F, 2.0F}, {3.0F, 5.0F}), -5.0F, 10.0F);
  is(product({-1.0F, 2.0F}, {-5.0F, -3.0F}), -10.0F, 5.0F);
  is(product({1.0F, 2.0F}, {3.0F, kInfinity}), 3.0F, kInfinity);
  is(product({-1.0F, 2.0F}, {3.0F, kInfinity}), -kInfinity, kInfinity);
  is(product({0.0F, 2.0F}, {3.0F, kInfinity}), -kInfinity, kInfinity);
}

}  // namespace
}  // namespace sheaf::test
