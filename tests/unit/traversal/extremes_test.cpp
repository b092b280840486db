// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Rays and scenes at the ends of what numbers can do. The traversal must lose nothing that testing
// every triangle with the same arithmetic finds.
#include <gtest/gtest.h>

#include <limits>

#include "test_mesh.h"

namespace sheaf::test {
namespace {

void expect_nothing_lost(const TestScene& scene, const Ray& ray) {
  const Hit expected = test_all(scene, ray);
  for (const auto scheme : kTraversalSchemes) ASSERT_EQ(trace_one(scene, ray, scheme), expected);
}

/// Zeros of either sign and numbers too small to invert, besides ordinary ones.
float odd_component(Random& random) {
  constexpr std::array<float, 8> kOdd = {0.0F,   -0.0F,   1e-40F, -1e-40F,
                                         1e-30F, -1e-30F, 1e-7F,  -1e-7F};
  return kOdd[random.below(kOdd.size())];
}

TEST(Extremes, AxisParallelRaysOnSplitPlanesAndBoxFaces) {
  const TestScene scene(lattice(4));
  Random random(41);
  for (int i = 0; i < 4000; ++i) {
    Vec3 origin;
    for (int axis = 0; axis < 3; ++axis) {
      // On a plane of the lattice, a little off it, or between two.
      origin[axis] = static_cast<float>(random.below(7)) - 1.0F;
      if (random.below(3) == 0) origin[axis] += random.uniform();
      if (random.below(6) == 0) origin[axis] = std::nextafter(origin[axis], 9.0F);
    }
    Vec3 direction(odd_component(random), odd_component(random), odd_component(random));
    direction[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1.0F : -1.0F;
    ASSERT_NO_FATAL_FAILURE(expect_nothing_lost(scene, make_ray(origin, direction))) << i;
  }
}

// The traversal moves origins by its error bound. Where the moved origin meets a plane that the ray
// runs along, the plane's distance is 0 · infinity: both sides count.
TEST(Extremes, OriginsWithinAHundredUlpsOfAPlaneThatTheRayRunsAlong) {
  const TestScene scene(lattice(4));
  Random random(40);
  for (const float zero : {0.0F, -0.0F}) {
    for (int plane = 0; plane <= 4; ++plane) {
      for (int ulps = -100; ulps <= 100; ++ulps) {
        const auto axis = static_cast<int>(random.below(3));
        Vec3 origin = 4.0F * random_point(random);
        origin[axis] = static_cast<float>(plane) + static_cast<float>(ulps) * 0x1p-23F;
        Vec3 direction = random_direction(random);
        direction[axis] = zero;
        ASSERT_NO_FATAL_FAILURE(
            expect_nothing_lost(scene, make_ray(origin, glm::normalize(direction))))
            << "plane " << plane << ", ulps " << ulps;
      }
    }
  }
}

TEST(Extremes, RaysInsideAPlaneOfTriangles) {
  const TestScene scene(lattice(3));
  Random random(42);
  for (int i = 0; i < 2000; ++i) {
    const auto axis = static_cast<int>(random.below(3));
    Vec3 origin = 3.0F * random_point(random);
    origin[axis] = static_cast<float>(random.below(4));
    Vec3 direction = random_direction(random);
    direction[axis] = odd_component(random);
    ASSERT_NO_FATAL_FAILURE(expect_nothing_lost(scene, make_ray(origin, glm::normalize(direction))))
        << i;
  }
}

TEST(Extremes, DiagonalRaysThroughLatticePoints) {
  const TestScene scene(lattice(4));
  Random random(43);
  for (int i = 0; i < 3000; ++i) {
    const auto point = [&] {
      const auto x = static_cast<float>(random.below(5));
      const auto y = static_cast<float>(random.below(5));
      return Vec3(x, y, static_cast<float>(random.below(5)));
    };
    const Vec3 from = point();
    const Vec3 to = point();
    if (from == to) continue;
    ASSERT_NO_FATAL_FAILURE(expect_nothing_lost(scene, make_ray(from, glm::normalize(to - from))))
        << i;
  }
}

TEST(Extremes, ScaledAndTranslatedScenes) {
  for (const float scale : {1e-6F, 1.0F, 1e6F}) {
    for (const float offset : {0.0F, 1e2F, 1e4F, 1e6F}) {
      Mesh mesh = soup(200, 0.3F, 44);
      mesh.transform(scale, scale * offset * Vec3(1.0F, -1.0F, 0.5F));
      const TestScene scene(mesh);
      Random random(45);
      for (int i = 0; i < 300; ++i) {
        const Ray ray = random_ray(random, scene.tree.bounds);
        ASSERT_NO_FATAL_FAILURE(expect_nothing_lost(scene, ray))
            << "scale " << scale << ", offset " << offset << ", ray " << i;
      }
    }
  }
}

TEST(Extremes, FarAwayOrigins) {
  const TestScene scene(soup(300, 0.3F, 46));
  Random random(47);
  for (const float distance : {1e2F, 1e4F, 1e6F, 1e8F}) {
    for (int i = 0; i < 500; ++i) {
      const Vec3 direction = random_direction(random);
      const Vec3 origin = random_point(random) - distance * direction;
      ASSERT_NO_FATAL_FAILURE(expect_nothing_lost(scene, make_ray(origin, direction))) << i;
    }
  }
}

TEST(Extremes, NeedlesAndDuplicates) {
  Mesh mesh = soup(150, 0.4F, 48);
  for (std::size_t i = 0; i < 100; ++i) {
    const auto t = mesh.triangles[i];
    const Vec3 a = mesh.positions[t[0]];
    const Vec3 b = mesh.positions[t[1]];
    mesh.add(a, b, a + (b - a) * 0.5F + 1e-6F * (mesh.positions[t[2]] - a));
    mesh.triangles.push_back(t);
  }
  const TestScene scene(mesh);
  Random random(49);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from = random_point(random);
    const auto& t = scene.records[random.below(scene.records.size())];
    const Vec3 at = t.a + random.uniform() * (t.b - t.a);
    const Ray ray = make_ray(from, glm::normalize(at - from));
    const Hit expected = test_all(scene, ray);
    const Hit found = trace_one(scene, ray, TraversalScheme::kMasked);
    ASSERT_EQ(found, trace_one(scene, ray, TraversalScheme::kSingle)) << i;
    ASSERT_EQ(found, expected) << i;
  }
}

TEST(Extremes, OverflowingArithmeticYieldsNoHitAtInfinity) {
  // One wall ahead and one behind, so that the origin lies inside the bounds.
  Mesh mesh;
  for (const float z : {1e30F, -1e30F}) {
    mesh.add(Vec3(-1e18F, -1e18F, z), Vec3(1e18F, -1e18F, z), Vec3(0.0F, 1e18F, z));
  }
  const TestScene scene(mesh);
  const Ray ray = make_ray(Vec3(0.0F), Vec3(0.0F, 0.0F, 1e-20F));
  EXPECT_EQ(trace_one(scene, ray, TraversalScheme::kSingle).triangle, kNoHit);
  EXPECT_EQ(trace_one(scene, ray, TraversalScheme::kMasked).triangle, kNoHit);
}

}  // namespace
}  // namespace sheaf::test
