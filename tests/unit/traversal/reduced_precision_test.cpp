// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Planes and rays in fewer bits: nothing that the exact walk visits is left out.
#include "traversal/reduced_precision.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "test_mesh.h"

namespace sheaf::test {
namespace {

using Leaves = std::set<std::uint32_t>;

/// Planes, rays and both in each of the reduced formats.
std::vector<ReducedPrecision> reduced_precisions(const Box& space) {
  std::vector<ReducedPrecision> all;
  for (const NumberFormat& format : kReducedFormats) {
    all.push_back({format, kFullPrecision, space});
    all.push_back({kFullPrecision, format, space});
    all.push_back({format, format, space});
  }
  return all;
}

class ReducedPrecisionTest : public testing::Test {
 protected:
  /// Calls check(scene, ray) with rays from within and without, some along an axis, some short.
  template <class Check>
  void for_many_rays(const Check& check) {
    Random random(17);
    for (const TestScene* scene : {&soup_, &sphere_, &lattice_}) {
      for (int i = 0; i < 300; ++i) {
        Ray ray = random_ray(random, scene->tree.bounds);
        if (random.below(4) == 0) graze(*scene, random, ray);
        if (random.below(3) == 0) {
          ray.tag.kind = RayKind::kShadow;
          ray.t_max = random.uniform();
        }
        ASSERT_NO_FATAL_FAILURE(check(*scene, ray)) << stability::describe(ray);
      }
    }
  }

  /// Lays the ray within a few roundings of the plane through a vertex.
  static void graze(const TestScene& scene, Random& random, Ray& ray) {
    const auto axis = static_cast<int>(random.below(3));
    const std::vector<Vec3>& positions = scene.mesh.positions;
    const float near = positions[random.below(positions.size())][axis];
    const float nudge = std::ldexp(4.0F * random.uniform() - 2.0F, -20);
    ray.origin[axis] = near + nudge * scene.tree.bounds.extent()[axis];
    ray.direction[axis] = 0.0F;
  }

  /// All leaves on a ray's way, whatever they hold.
  static Leaves leaves_on_way(const ReducedPrecision& precision, const TestScene& scene,
                              const Ray& ray) {
    Leaves leaves;
    walk_reduced(precision, scene.tree, ray, [&](std::uint32_t leaf) {
      leaves.insert(leaf);
      return ray.t_max;
    });
    return leaves;
  }

  const TestScene soup_{soup(800, 0.12F, 5)};
  const TestScene sphere_{bumpy_sphere(20, 30, 0.1F)};
  const TestScene lattice_{lattice(5)};
};

TEST(StoredAlike, ContainsTheValueAndLittleElse) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const float value = 8.0F * random.uniform() - 4.0F;
    const Range space{-3.0F, 2.5F};
    for (const NumberFormat& format : kReducedFormats) {
      const Range range = stored_alike(format, value, space);
      ASSERT_LE(range.lo, value) << format.name;
      ASSERT_GE(range.hi, value) << format.name;
      if (value < space.lo || value > space.hi) continue;
      const float share =
          std::ldexp(1.01F, format.encoding == Encoding::kHalf ? -10 : -format.bits);
      const float whole = format.encoding == Encoding::kHalf ? 4.0F : space.hi - space.lo;
      ASSERT_LE(range.hi - range.lo, share * whole) << format.name << " of " << value;
    }
  }
}

TEST(StoredAlike, HasNoEndWhereAFormatEnds) {
  const Range below = stored_alike(kReducedFormats[0], -1e6F, {});
  EXPECT_TRUE(std::isinf(below.lo));
  EXPECT_EQ(below.hi, -65504.0F);
  const Range above = stored_alike(kReducedFormats[0], 1e6F, {});
  EXPECT_EQ(above.lo, 65504.0F);
  EXPECT_TRUE(std::isinf(above.hi));
  const Range fixed = stored_alike(kReducedFormats[3], 7.0F, {0.0F, 2.0F});
  EXPECT_EQ(fixed.lo, 2.0F);
  EXPECT_TRUE(std::isinf(fixed.hi));
}

TEST_F(ReducedPrecisionTest, FullPrecisionTakesTheMachinesVerySteps) {
  for_many_rays([](const TestScene& scene, const Ray& ray) {
    RayPacket packet;
    packet.clear(1);
    packet.put(0, ray);
    TraceCounts counts;
    trace_packet(TraversalScheme::kSingle, scene.tree, scene.records, packet, nullptr, nullptr,
                 counts);
    const ReducedTrace found = trace_reduced({}, scene.tree, scene.records, ray);
    ASSERT_EQ(found.steps, counts.lane_inner_visits);
    ASSERT_EQ(found.tests, counts.lane_triangle_tests);
    ASSERT_EQ(found.triangle, packet.hit_triangle[0]);
    for (const auto& [reduced, machine] : {std::pair{found.t, packet.hit_t[0]},
                                           {found.u, packet.hit_u[0]},
                                           {found.v, packet.hit_v[0]}}) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(reduced), std::bit_cast<std::uint32_t>(machine));
    }
  });
}

TEST_F(ReducedPrecisionTest, ARayIsStoppedAtItsEndAndAShadowRayBefore) {
  const ReducedTrace first =
      trace_reduced({}, sphere_.tree, sphere_.records, make_ray({0, 0, 3}, {0.1F, 0.2F, -1}));
  ASSERT_NE(first.triangle, kNoHit);
  Ray ray = make_ray({0, 0, 3}, {0.1F, 0.2F, -1});
  ray.t_max = first.t;
  EXPECT_EQ(trace_reduced({}, sphere_.tree, sphere_.records, ray).triangle, first.triangle);
  ray.tag.kind = RayKind::kShadow;
  EXPECT_EQ(trace_reduced({}, sphere_.tree, sphere_.records, ray).triangle, kNoHit);
}

TEST_F(ReducedPrecisionTest, VisitsEveryLeafThatTheExactWalkVisits) {
  std::size_t exact_leaves = 0;
  std::size_t most_leaves = 0;
  for_many_rays([&](const TestScene& scene, const Ray& ray) {
    const Leaves exact = leaves_on_way({}, scene, ray);
    exact_leaves += exact.size();
    for (const ReducedPrecision& precision : reduced_precisions(scene.tree.bounds)) {
      const Leaves reduced = leaves_on_way(precision, scene, ray);
      ASSERT_TRUE(std::ranges::includes(reduced, exact))
          << "planes " << precision.planes.name << ", rays " << precision.rays.name;
      if (precision.planes.bits == 8 && precision.rays.bits == 8) most_leaves += reduced.size();
    }
  });
  EXPECT_GT(most_leaves, exact_leaves);
}

TEST_F(ReducedPrecisionTest, LosesNoHit) {
  for_many_rays([](const TestScene& scene, const Ray& ray) {
    const ReducedTrace exact = trace_reduced({}, scene.tree, scene.records, ray);
    for (const ReducedPrecision& precision : reduced_precisions(scene.tree.bounds)) {
      const ReducedTrace found = trace_reduced(precision, scene.tree, scene.records, ray);
      ASSERT_EQ(found.triangle == kNoHit, exact.triangle == kNoHit);
      if (ray.tag.kind == RayKind::kShadow) continue;
      ASSERT_EQ(found.triangle, exact.triangle);
      ASSERT_EQ(found.t, exact.t);
    }
  });
}

}  // namespace
}  // namespace sheaf::test
