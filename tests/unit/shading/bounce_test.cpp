// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "base/random.h"
#include "scene_builder.h"
#include "shading/dielectric.h"
#include "shading/ray_offset.h"
#include "shading/shader.h"

namespace sheaf::test {
namespace {

const Vec3 kUp(0.0F, 1.0F, 0.0F);

Material mirror() {
  Material m;
  m.mirror_weight = 1.0F;
  m.diffuse_weight = 0.0F;
  return m;
}

Material glass(float ior) {
  Material m;
  m.transmission = 1.0F;
  m.diffuse_weight = 0.0F;
  m.ior = ior;
  return m;
}

/// What a ray spawns where it meets the floor at (0, 0, 0).
struct Bounce {
  Ray parent;
  std::optional<Ray> reflected;
  std::optional<Ray> refracted;
};

Bounce bounce(const Shader& shader, const Ray& ray, const Hit& hit) {
  Bounce result{ray, std::nullopt, std::nullopt};
  const Surface s = shader.surface(ray, hit);
  Ray spawned;
  if (shader.reflect(ray, s, spawned)) result.reflected = spawned;
  if (shader.refract(ray, s, spawned)) result.refracted = spawned;
  return result;
}

Bounce bounce(const Material& material, const Vec3& eye, const Shader::Options& options = {}) {
  const Floor floor{material};
  return bounce(Shader(floor.scene(), options), ray_between(eye, Vec3(0.0F)), floor.hit);
}

/// A floor whose three corners have the given normal.
Bounce bounce_off_tilted(const Material& material, const Vec3& eye, const Vec3& normal) {
  SceneBuilder b;
  b.material(material);
  b.triangle({Vec3(-1.0F, 0.0F, 1.0F), Vec3(3.0F, 0.0F, 1.0F), Vec3(-1.0F, 0.0F, -3.0F)},
             {normal, normal, normal});
  return bounce(Shader(b.scene, {}), ray_between(eye, Vec3(0.0F)), {1.0F, 0.25F, 0.25F, 0});
}

TEST(Reflection, MirrorsTheDirectionAndStartsOffTheSurface) {
  const Bounce b = bounce(mirror(), {-3.0F, 4.0F, 0.0F});
  ASSERT_TRUE(b.reflected);
  EXPECT_FALSE(b.refracted);
  EXPECT_LT(glm::length(b.reflected->direction - Vec3(0.6F, 0.8F, 0.0F)), 1e-7F);
  EXPECT_EQ(b.reflected->origin, offset_origin(Vec3(0.0F), kUp));
  EXPECT_EQ(b.reflected->t_max, std::numeric_limits<float>::infinity());
}

TEST(Reflection, LeavesTheBackOfASurfaceToTheBack) {
  const Bounce b = bounce(mirror(), {-3.0F, -4.0F, 0.0F});
  ASSERT_TRUE(b.reflected);
  EXPECT_LT(glm::length(b.reflected->direction - Vec3(0.6F, -0.8F, 0.0F)), 1e-7F);
  EXPECT_LT(b.reflected->origin.y, 0.0F);
}

TEST(Reflection, FollowsTheInterpolatedNormal) {
  const Vec3 tilted = glm::normalize(Vec3(0.2F, 1.0F, 0.0F));
  const Bounce b = bounce_off_tilted(mirror(), {0.0F, 1.0F, 0.0F}, tilted);
  ASSERT_TRUE(b.reflected);
  const float angle = 2.0F * std::atan(0.2F);
  EXPECT_LT(glm::length(b.reflected->direction - Vec3(std::sin(angle), std::cos(angle), 0.0F)),
            2e-7F);
}

TEST(Reflection, DoesNotLeadThroughTheSurface) {
  // About this normal the ray would be mirrored to below the floor.
  const Vec3 tilted = glm::normalize(Vec3(-1.0F, 0.1F, 0.0F));
  const Bounce b = bounce_off_tilted(mirror(), {-4.0F, 1.0F, 0.0F}, tilted);
  ASSERT_TRUE(b.reflected);
  const Vec3 geometric = glm::normalize(Vec3(4.0F, 1.0F, 0.0F));
  EXPECT_LT(glm::length(b.reflected->direction - geometric), 2e-7F);
}

TEST(Reflection, IsTintedOnlyIfTheMaterialSaysSo) {
  Material m = mirror();
  m.mirror_weight = 0.5F;
  m.base_color = {0.8F, 0.4F, 0.2F};
  EXPECT_EQ(bounce(m, kUp).reflected->weight, 0.5F * m.base_color);
  m.mirror_tinted = false;
  EXPECT_EQ(bounce(m, kUp).reflected->weight, Vec3(0.5F));
}

TEST(Reflection, KeepsItsLengthOverAHundredBounces) {
  // Sent back each time to where it came from, a ray would grow or shrink by the rounding error of
  // the mirror's normal, for most normals to beyond the bound.
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    const Vec3 normal = glm::normalize(Vec3(random.uniform(), 1.0F, random.uniform()));
    SceneBuilder b;
    b.material(mirror());
    b.triangle({Vec3(-1.0F, 0.0F, 1.0F), Vec3(3.0F, 0.0F, 1.0F), Vec3(-1.0F, 0.0F, -3.0F)},
               {normal, normal, normal});
    const Shader shader(b.scene, {100, 0.0F});
    const Hit hit{1.0F, 0.25F, 0.25F, 0};
    Ray ray = ray_between({0.1F, 1.0F, 0.2F}, Vec3(0.0F));
    while (const auto reflected = bounce(shader, ray, hit).reflected) {
      ray = *reflected;
      ray.direction = -ray.direction;
    }
    EXPECT_EQ(ray.tag.depth, 100);
    EXPECT_NEAR(glm::length(Vec3d(ray.direction)), 1.0, 1.2e-7);
  }
}

TEST(Bounce, EndsAtTheRecursionLevel) {
  Material m = glass(1.5F);
  const Floor floor{m};
  const Shader shader(floor.scene(), {2, 0.0F});
  Ray ray = ray_between({0.3F, 1.0F, 0.2F}, Vec3(0.0F));
  for (const std::uint8_t depth : {std::uint8_t{0}, std::uint8_t{1}}) {
    ray.tag.depth = depth;
    const Bounce b = bounce(shader, ray, floor.hit);
    ASSERT_TRUE(b.reflected && b.refracted);
    EXPECT_EQ(b.reflected->tag.depth, depth + 1);
    EXPECT_EQ(b.refracted->tag.depth, depth + 1);
  }
  ray.tag.depth = 2;
  const Bounce b = bounce(shader, ray, floor.hit);
  EXPECT_FALSE(b.reflected || b.refracted);
}

TEST(Bounce, TagsItsRaysAsChildren) {
  const Bounce b = bounce(glass(1.5F), {0.3F, 1.0F, 0.2F});
  ASSERT_TRUE(b.reflected && b.refracted);
  EXPECT_EQ(b.reflected->tag.id, child_ray_id(b.parent.tag.id, 0));
  EXPECT_EQ(b.refracted->tag.id, child_ray_id(b.parent.tag.id, 1));
  EXPECT_EQ(b.reflected->tag.kind, RayKind::kReflection);
  EXPECT_EQ(b.refracted->tag.kind, RayKind::kRefraction);
  EXPECT_EQ(b.reflected->tag.pixel, b.parent.tag.pixel);
  EXPECT_EQ(b.refracted->tag.pixel, b.parent.tag.pixel);
}

TEST(Bounce, ComesOnlyFromMaterialsThatHaveThePart) {
  EXPECT_FALSE(bounce(Material{}, kUp).reflected);
  EXPECT_FALSE(bounce(Material{}, kUp).refracted);
  Material unlit = glass(1.5F);
  unlit.unlit = true;
  EXPECT_FALSE(bounce(unlit, kUp).reflected);
  EXPECT_FALSE(bounce(unlit, kUp).refracted);
}

TEST(Bounce, IsNotSpawnedAtOrBelowTheCutoff) {
  Material m = glass(1.5F);
  m.transmission = 0.5F;  // head-on: reflection 0.02, refraction 0.48
  EXPECT_TRUE(bounce(m, kUp, {1, 0.019F}).reflected);
  EXPECT_FALSE(bounce(m, kUp, {1, 0.021F}).reflected);
  EXPECT_TRUE(bounce(m, kUp, {1, 0.47F}).refracted);
  EXPECT_FALSE(bounce(m, kUp, {1, 0.49F}).refracted);
  m = mirror();
  m.mirror_weight = 0.25F;
  EXPECT_FALSE(bounce(m, kUp, {1, 0.25F}).reflected) << "at the cutoff";
}

TEST(Refraction, FollowsSnellsLaw) {
  for (const float ior : {1.1F, 1.33F, 1.5F, 2.4F}) {
    const Bounce b = bounce(glass(ior), {-1.0F, 1.0F, 0.0F});
    ASSERT_TRUE(b.refracted);
    EXPECT_NEAR(b.refracted->direction.x, std::sqrt(0.5F) / ior, 1e-6F);
    EXPECT_LT(b.refracted->direction.y, 0.0F);
    EXPECT_EQ(b.refracted->origin, offset_origin(Vec3(0.0F), -kUp));
  }
}

TEST(Refraction, BendsAwayFromTheNormalOnTheWayOut) {
  const Bounce b = bounce(glass(1.5F), {-0.3F, -1.0F, 0.0F});
  ASSERT_TRUE(b.refracted);
  EXPECT_NEAR(b.refracted->direction.x, 1.5F * 0.3F / std::sqrt(1.09F), 1e-6F);
  EXPECT_GT(b.refracted->direction.y, 0.0F);
  EXPECT_GT(b.refracted->origin.y, 0.0F);
}

TEST(Refraction, IsTintedAndSharesTheRestWithTheReflection) {
  Material m = glass(1.5F);
  m.transmission = 0.5F;
  m.base_color = {1.0F, 0.5F, 0.25F};
  const Bounce b = bounce(m, kUp);
  ASSERT_TRUE(b.reflected && b.refracted);
  EXPECT_LT(glm::length(b.reflected->weight - Vec3(0.5F * 0.04F)), 1e-7F);
  EXPECT_LT(glm::length(b.refracted->weight - 0.5F * 0.96F * m.base_color), 1e-6F);
}

TEST(Refraction, GivesWayToTotalInternalReflection) {
  // From inside glass of 1.5 the critical angle is 41.8 degrees.
  const Bounce total = bounce(glass(1.5F), {-1.0F, -1.0F, 0.0F});
  ASSERT_TRUE(total.reflected);
  EXPECT_FALSE(total.refracted);
  EXPECT_EQ(total.reflected->weight, Vec3(1.0F));
  EXPECT_TRUE(bounce(glass(1.5F), {-0.8F, -1.0F, 0.0F}).refracted);    // 38.7 degrees
  EXPECT_FALSE(bounce(glass(1.5F), {-0.93F, -1.0F, 0.0F}).refracted);  // 42.9 degrees
}

TEST(Refraction, GoesStraightOnThroughIndexOne) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 eye(random.uniform(), random.uniform() - 0.5F, random.uniform());
    const Bounce b = bounce(glass(1.0F), eye);
    EXPECT_FALSE(b.reflected);
    ASSERT_TRUE(b.refracted);
    EXPECT_EQ(b.refracted->direction, b.parent.direction) << i;
    EXPECT_EQ(b.refracted->weight, Vec3(1.0F));
  }
}

TEST(Refraction, GoesStraightOnWhereItWouldNotLeadThroughTheSurface) {
  // On the way out of glass, about this normal, the ray would be bent back to the inner side.
  const Vec3 tilted = glm::normalize(Vec3(0.954F, 0.3F, 0.0F));
  const Bounce b = bounce_off_tilted(glass(1.5F), {-1.0F, -0.05F, 0.0F}, tilted);
  ASSERT_TRUE(b.refracted);
  EXPECT_EQ(b.refracted->direction, b.parent.direction);
  EXPECT_GT(b.refracted->origin.y, 0.0F);
}

TEST(Fresnel, ReflectsTheTextbookShareHeadOn) {
  for (const float n : {1.1F, 1.33F, 1.5F, 2.4F}) {
    const float expected = (n - 1.0F) * (n - 1.0F) / ((n + 1.0F) * (n + 1.0F));
    EXPECT_NEAR(dielectric(1.0F, 1.0F / n).reflectance, expected, 1e-6F);
    EXPECT_NEAR(dielectric(1.0F, n).reflectance, expected, 1e-6F);
  }
}

TEST(Fresnel, LosesOnePolarisationAtBrewstersAngle) {
  const float n = 1.5F;
  const float cosine = 1.0F / std::sqrt(1.0F + n * n);  // tan θ = n
  const float s = (1.0F - n * n) / (1.0F + n * n);
  EXPECT_NEAR(dielectric(cosine, 1.0F / n).reflectance, 0.5F * s * s, 1e-6F);
}

TEST(Fresnel, ReflectsEverythingAtGrazingAngles) {
  EXPECT_NEAR(dielectric(1e-6F, 1.0F / 1.5F).reflectance, 1.0F, 1e-4F);
  EXPECT_EQ(dielectric(0.0F, 1.0F / 1.5F).reflectance, 1.0F);
}

TEST(Fresnel, IsTheSameBothWays) {
  for (int i = 1; i <= 100; ++i) {
    const float cosine = static_cast<float>(i) / 100.0F;
    const Dielectric in = dielectric(cosine, 1.0F / 1.5F);
    EXPECT_NEAR(dielectric(in.cos_refracted, 1.5F).reflectance, in.reflectance, 1e-6F / cosine);
    EXPECT_LT(in.reflectance, 1.0F);
  }
}

TEST(Fresnel, KnowsNoBoundaryAtIndexOne) {
  for (const float cosine : {0.0F, 1e-4F, 0.5F, 1.0F}) {
    EXPECT_EQ(dielectric(cosine, 1.0F).reflectance, 0.0F);
    EXPECT_EQ(dielectric(cosine, 1.0F).cos_refracted, cosine);
  }
}

TEST(Bounce, SpendsNoMoreThanTheParentBrought) {
  for (int angle = 0; angle < 90; angle += 3) {
    const auto radians = static_cast<float>(angle) * 0.0174533F;
    for (const float side : {1.0F, -1.0F}) {
      const Bounce b = bounce(glass(1.5F), {std::sin(radians), side * std::cos(radians), 0.0F});
      float sum = 0.0F;
      sum += b.reflected ? b.reflected->weight.x : 0.0F;
      sum += b.refracted ? b.refracted->weight.x : 0.0F;
      EXPECT_NEAR(sum, 1.0F, 1.2e-7F) << angle;
    }
  }
}

}  // namespace
}  // namespace sheaf::test
