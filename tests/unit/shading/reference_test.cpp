// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "shading/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "middle_split_tree.h"
#include "scene_builder.h"
#include "shading/reference_hit.h"

namespace sheaf::test {
namespace {

Vec3d random_point(Random& random) {
  const auto coordinate = [&] { return 2.0 * static_cast<double>(random.uniform()) - 1.0; };
  const double x = coordinate();
  const double y = coordinate();
  return {x, y, coordinate()};
}

TEST(ReferenceHits, AreTheSameWithAndWithoutATree) {
  Random random(3);
  SceneBuilder b;
  b.material({});
  for (int i = 0; i < 300; ++i) {
    const Vec3 centre(random_point(random));
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) corner = centre + 0.4F * Vec3(random_point(random));
    b.flat_triangle(corners);
  }
  const KdTree flat = single_leaf(b.scene);
  const KdTree deep = MiddleSplitTree(b.scene).tree;
  ASSERT_GT(deep.nodes.size(), 50U);
  int num_hits = 0;
  for (int i = 0; i < 5000; ++i) {
    ReferenceRay ray{2.0 * random_point(random), random_point(random)};
    if (i % 3 == 0) ray.direction[i % 2] = 0.0;
    if (i % 5 == 0) ray.origin[i % 3] = static_cast<double>(deep.nodes[0].split());
    if (i % 4 == 0) ray.t_max = 1.5;
    ray.direction = glm::normalize(ray.direction);
    const auto expected = reference_closest_hit(b.scene, flat, ray);
    const auto found = reference_closest_hit(b.scene, deep, ray);
    ASSERT_EQ(found.has_value(), expected.has_value()) << i;
    ASSERT_EQ(reference_occluded(b.scene, deep, ray), expected.has_value()) << i;
    if (!found) continue;
    ++num_hits;
    ASSERT_EQ(found->triangle, expected->triangle) << i;
    ASSERT_EQ(found->t, expected->t) << i;
  }
  EXPECT_GT(num_hits, 1000);
}

TEST(ReferenceHits, LiesWhereTheBarycentricsSay) {
  const Floor floor{Material{}};
  const KdTree tree = single_leaf(floor.scene());
  const auto hit = reference_closest_hit(floor.scene(), tree, {{0.0, 2.0, 0.0}, {0.0, -1.0, 0.0}});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->t, 2.0);
  EXPECT_DOUBLE_EQ(hit->u, 0.25);
  EXPECT_DOUBLE_EQ(hit->v, 0.25);
}

TEST(ReferenceHits, GoToTheLowerPrimitiveAtEqualDistance) {
  SceneBuilder b;
  b.material({});
  for (int i = 0; i < 3; ++i) b.quad({-1.0F, 0.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F});
  const KdTree tree = single_leaf(b.scene);
  const auto hit = reference_closest_hit(b.scene, tree, {{0.5, 2.0, 0.25}, {0.0, -1.0, 0.0}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 0U);
}

TEST(ReferenceHits, EndAtTMaxWhichOnlyTheNearestHitMayReach) {
  const Floor floor{Material{}};
  const KdTree tree = single_leaf(floor.scene());
  ReferenceRay ray{{0.0, 2.0, 0.0}, {0.0, -1.0, 0.0}, 2.0};
  EXPECT_TRUE(reference_closest_hit(floor.scene(), tree, ray));
  EXPECT_FALSE(reference_occluded(floor.scene(), tree, ray));
  ray.t_max = 2.1;
  EXPECT_TRUE(reference_occluded(floor.scene(), tree, ray));
  ray.t_max = 1.9;
  EXPECT_FALSE(reference_closest_hit(floor.scene(), tree, ray));
}

TEST(ReferenceHits, DoNotSlipThroughSharedEdgesAndVertices) {
  Random random(5);
  SceneBuilder b;
  b.material({});
  b.sphere(Vec3(0.0F), 1.0F, 12);
  const KdTree tree = single_leaf(b.scene);
  for (const auto& triangle : b.scene.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3d p(b.scene.positions[triangle[corner]]);
      const Vec3d q(b.scene.positions[triangle[(corner + 1) % 3]]);
      const Vec3d origin = 0.3 * random_point(random);
      for (const double share : {0.0, 0.25, 0.5, 1.0 / 3.0}) {
        const Vec3d direction = glm::normalize(p + share * (q - p) - origin);
        ASSERT_TRUE(reference_closest_hit(b.scene, tree, {origin, direction}));
      }
    }
  }
}

ReferenceTracer::Options level(std::uint32_t recursion_level) {
  return {8, 6, recursion_level};
}

TEST(ReferenceTracer, ShowsLambertsLaw) {
  Material m;
  m.base_color = {0.8F, 0.4F, 0.2F};
  m.emission = Vec3(0.125F);
  Floor floor{m};
  Light light;
  light.position = {4.0F, 3.0F, 0.0F};
  light.intensity = Vec3(100.0F);
  floor.builder.scene.lights = {light};
  const KdTree tree = single_leaf(floor.scene());
  const ReferenceTracer tracer(floor.scene(), tree, level(0));
  const Vec3d found = tracer.radiance({0.0, 2.0, 0.0}, {0.0, -1.0, 0.0});
  const Vec3d expected = 0.125 + Vec3d(m.base_color) * 100.0 / std::numbers::pi * 0.6 / 25.0;
  EXPECT_LT(glm::length(found - expected), 1e-12);
}

TEST(ReferenceTracer, CastsShadows) {
  Floor floor{Material{}};
  Light light;
  light.position = {0.0F, 3.0F, 0.0F};
  floor.builder.scene.lights = {light};
  floor.builder.quad({-0.1F, 2.0F, 0.1F}, {0.2F, 0.0F, 0.0F}, {0.0F, 0.0F, -0.2F});
  const KdTree tree = single_leaf(floor.scene());
  const ReferenceTracer tracer(floor.scene(), tree, level(0));
  const Vec3d down_aslant = glm::normalize(Vec3d(0.0, -1.0, -0.5));
  EXPECT_EQ(tracer.radiance({0.0, 1.0, 0.5}, down_aslant), Vec3d(0.0));
  EXPECT_GT(tracer.radiance({1.0, 1.0, 0.5}, down_aslant).x, 0.0);
}

TEST(ReferenceTracer, CountsReflectionsUpToTheRecursionLevel) {
  // Two mirrors facing each other, each adding 1 and passing on a half.
  Material m;
  m.diffuse_weight = 0.0F;
  m.mirror_weight = 0.5F;
  m.emission = Vec3(1.0F);
  SceneBuilder b;
  b.material(m);
  b.quad({-1.0F, 0.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -2.0F});
  b.quad({-1.0F, 1.0F, 1.0F}, {0.0F, 0.0F, -2.0F}, {2.0F, 0.0F, 0.0F});
  const KdTree tree = single_leaf(b.scene);
  for (const std::uint32_t depth : {0U, 1U, 2U, 40U, 100U}) {
    const ReferenceTracer tracer(b.scene, tree, level(depth));
    const double expected = 2.0 - std::ldexp(1.0, -static_cast<int>(depth));
    EXPECT_NEAR(tracer.radiance({0.0, 0.5, 0.0}, {0.0, -1.0, 0.0}).y, expected, 1e-14) << depth;
  }
}

TEST(ReferenceTracer, StaysInAClosedMeshFarFromTheOrigin) {
  Material m;
  m.diffuse_weight = 0.0F;
  m.mirror_weight = 1.0F;
  SceneBuilder b;
  b.material(m);
  const Vec3 centre(1e5F, -1e5F, 1e5F);
  b.sphere(centre, 1.0F, 12);
  b.scene.background = Vec3(1.0F);
  const KdTree tree = MiddleSplitTree(b.scene).tree;
  const ReferenceTracer tracer(b.scene, tree, level(50));
  Random random(8);
  for (int i = 0; i < 50; ++i) {
    const Vec3d direction = glm::normalize(random_point(random));
    EXPECT_EQ(tracer.radiance(Vec3d(centre), direction), Vec3d(0.0)) << i;
  }
}

TEST(ReferenceTracer, MakesAGlassSphereVanishInAUniformWorld) {
  Material m;
  m.diffuse_weight = 0.0F;
  m.transmission = 1.0F;
  SceneBuilder b;
  b.material(m);
  b.sphere(Vec3(0.0F), 1.0F, 24);
  b.scene.background = Vec3(3.0F);
  const KdTree tree = MiddleSplitTree(b.scene).tree;
  const ReferenceTracer tracer(b.scene, tree, {8, 6, 12, 1e-7});
  for (const double x : {0.0, 0.3, 0.7}) {
    EXPECT_NEAR(tracer.radiance({x, 0.1, 5.0}, {0.0, 0.0, -1.0}).x, 3.0, 2e-4) << x;
  }
}

TEST(ReferenceTracer, CutsSmallWeights) {
  Material m;
  m.diffuse_weight = 0.0F;
  m.mirror_weight = 0.25F;
  Floor floor{m};
  floor.builder.scene.background = Vec3(1.0F);
  const KdTree tree = single_leaf(floor.scene());
  const auto seen = [&](double cutoff) {
    const ReferenceTracer tracer(floor.scene(), tree, {8, 6, 1, cutoff});
    return tracer.radiance({0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}).x;
  };
  EXPECT_EQ(seen(0.24), 0.25);
  EXPECT_EQ(seen(0.25), 0.0);
}

TEST(ReferenceTracer, LooksThroughPixelCentres) {
  // Unlit quads of different colours in the four quarters of the view.
  SceneBuilder b;
  for (const Vec3& color : {Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 1.0F, 0.0F), Vec3(0.0F, 0.0F, 1.0F),
                            Vec3(1.0F, 1.0F, 0.0F)}) {
    Material m;
    m.base_color = color;
    m.unlit = true;
    b.material(m);
  }
  const Vec3 x(9.0F, 0.0F, 0.0F);
  const Vec3 y(0.0F, 9.0F, 0.0F);
  b.quad({-9.0F, 0.0F, -2.0F}, x, y, 0);
  b.quad({0.0F, 0.0F, -2.0F}, x, y, 1);
  b.quad({-9.0F, -9.0F, -2.0F}, x, y, 2);
  b.quad({0.0F, -9.0F, -2.0F}, x, y, 3);
  const KdTree tree = single_leaf(b.scene);
  for (const bool orthographic : {false, true}) {
    b.scene.camera.orthographic = orthographic;
    const ReferenceTracer tracer(b.scene, tree, level(0));
    EXPECT_EQ(tracer.pixel(3, 2), Vec3d(1.0, 0.0, 0.0));
    EXPECT_EQ(tracer.pixel(4, 2), Vec3d(0.0, 1.0, 0.0));
    EXPECT_EQ(tracer.pixel(3, 3), Vec3d(0.0, 0.0, 1.0));
    EXPECT_EQ(tracer.pixel(4, 3), Vec3d(1.0, 1.0, 0.0));
  }
}

}  // namespace
}  // namespace sheaf::test
