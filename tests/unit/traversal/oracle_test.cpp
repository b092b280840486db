// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Hits against three oracles: the same triangle test on all triangles, double precision, Embree.
#include <gtest/gtest.h>

#include <cmath>

#include "support/embree_oracle.h"
#include "test_mesh.h"

namespace sheaf::test {
namespace {

struct Case {
  const char* name;
  Mesh mesh;
};

std::vector<Case> cases() {
  return {{"sparse soup", soup(300, 0.5F, 1)},
          {"dense soup", soup(2000, 0.1F, 2)},
          {"closed mesh", bumpy_sphere(20, 30, 0.1F)},
          {"lattice", lattice(4)}};
}

TEST(TraceOracle, FindsExactlyWhatTestingEveryTriangleFinds) {
  for (const Case& c : cases()) {
    const TestScene scene(c.mesh);
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
      const Ray ray = random_ray(random, scene.tree.bounds);
      const Hit expected = test_all(scene, ray);
      for (const auto scheme : kTraversalSchemes) {
        ASSERT_EQ(trace_one(scene, ray, scheme), expected) << c.name << ", ray " << i;
      }
    }
  }
}

TEST(TraceOracle, AgreesWithDoublePrecisionUpToRounding) {
  for (const Case& c : cases()) {
    const TestScene scene(c.mesh);
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
      const Ray ray = random_ray(random, scene.tree.bounds);
      ASSERT_TRUE(explains(scene, ray, trace_one(scene, ray))) << c.name << ", ray " << i;
    }
  }
}

// Where Embree names another triangle, its answer too must be one that rounding explains: the ray
// then passes an edge closer than single precision can tell.
TEST(TraceOracle, AgreesWithEmbreeButForRaysThroughEdges) {
  for (const Case& c : cases()) {
    const TestScene scene(c.mesh);
    const EmbreeOracle embree(scene.mesh.positions, scene.mesh.triangles);
    Random random(5);
    int disagreements = 0;
    constexpr int kRays = 20000;
    for (int i = 0; i < kRays; ++i) {
      const Ray ray = random_ray(random, scene.tree.bounds);
      const Hit ours = trace_one(scene, ray);
      const EmbreeOracle::Hit theirs = embree.closest(ray);
      if (ours.triangle != theirs.triangle) {
        ++disagreements;
        EXPECT_TRUE(explains(scene, ray, ours)) << c.name << ", ray " << i;
        EXPECT_TRUE(explains(scene, ray, {theirs.triangle, theirs.t})) << c.name << ", ray " << i;
      } else if (ours.triangle != kNoHit) {
        const double bound = 2.0 * hit_in_doubles(scene.records[ours.triangle], ray).t_error;
        EXPECT_LE(std::abs(double{ours.t} - double{theirs.t}), bound) << c.name << ", ray " << i;
      }
    }
    EXPECT_LE(disagreements, kRays / 2000) << c.name;
  }
}

TEST(TraceOracle, AnyHitAgreesWithClosestHit) {
  for (const Case& c : cases()) {
    const TestScene scene(c.mesh);
    Random random(6);
    for (int i = 0; i < 2000; ++i) {
      Ray ray = random_ray(random, scene.tree.bounds);
      ray.t_max = random.uniform() * 2.0F;
      const Hit closest = test_all(scene, ray);
      ray.tag.kind = RayKind::kShadow;
      const bool blocked = closest.triangle != kNoHit && closest.t < ray.t_max;
      for (const auto scheme : kTraversalSchemes) {
        ASSERT_EQ(trace_one(scene, ray, scheme).triangle != kNoHit, blocked)
            << c.name << ", ray " << i;
      }
    }
  }
}

}  // namespace
}  // namespace sheaf::test
