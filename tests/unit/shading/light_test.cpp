// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "scene_builder.h"
#include "shading/lighting.h"
#include "shading/ray_offset.h"
#include "shading/shader.h"

namespace sheaf::test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kFloatMax = std::numeric_limits<float>::max();

Light point_light(const Vec3& position, const Vec3& intensity) {
  Light light;
  light.position = position;
  light.intensity = intensity;
  return light;
}

/// A spot above the floor's point (0, 0, 0), shining down, its cones 20 and 40 degrees wide.
Light spot_light(const Vec3& position) {
  Light light = point_light(position, Vec3(1.0F));
  light.type = Light::Type::kSpot;
  light.direction = Vec3(0.0F, -1.0F, 0.0F);
  light.cos_inner_cone = std::cos(20.0F * kPi / 180.0F);
  light.cos_outer_cone = std::cos(40.0F * kPi / 180.0F);
  return light;
}

/// The shadow ray that a hit of the floor at (0, 0, 0), seen from `eye`, spawns.
std::optional<Ray> shadow_ray(const Light& light, const Material& material = {},
                              const Vec3& eye = {0.3F, 1.0F, 0.2F},
                              const Shader::Options& options = {}) {
  Floor floor{material};
  floor.builder.scene.lights = {light};
  const Shader shader(floor.scene(), options);
  const Ray ray = ray_between(eye, Vec3(0.0F));
  Ray spawned;
  return shader.shadow(ray, shader.surface(ray, floor.hit), 0, spawned) ? std::optional(spawned)
                                                                        : std::nullopt;
}

/// Irradiance that reaches the floor's point, from the weight of its shadow ray; 0 without one.
float irradiance(const Light& light) {
  const auto ray = shadow_ray(light);
  return ray ? ray->weight.x * kPi : 0.0F;
}

TEST(ShadowRay, CarriesLambertsLawUnderAPointLight) {
  Material m;
  m.base_color = {0.8F, 0.4F, 0.2F};
  m.diffuse_weight = 0.5F;
  // 3 up and 4 aside: distance 5, cosine 3/5.
  const auto ray = shadow_ray(point_light({4.0F, 3.0F, 0.0F}, {100.0F, 200.0F, 300.0F}), m);
  ASSERT_TRUE(ray);
  const float share = 0.5F / kPi * 0.6F / 25.0F;
  EXPECT_NEAR(ray->weight.x, 80.0F * share, 80.0F * share * 1e-6F);
  EXPECT_NEAR(ray->weight.y, 80.0F * share, 80.0F * share * 1e-6F);
  EXPECT_NEAR(ray->weight.z, 60.0F * share, 60.0F * share * 1e-6F);
}

TEST(ShadowRay, RunsFromTheOffsetOriginIntoTheLight) {
  const Vec3 position(4.0F, 3.0F, 0.0F);
  const auto ray = shadow_ray(point_light(position, Vec3(1.0F)));
  ASSERT_TRUE(ray);
  EXPECT_EQ(ray->origin, offset_origin(Vec3(0.0F), {0.0F, 1.0F, 0.0F}));
  EXPECT_LT(glm::length(ray->origin + ray->t_max * ray->direction - position), 2e-6F);
  EXPECT_NEAR(glm::length(ray->direction), 1.0F, 2e-7F);
}

TEST(ShadowRay, LeavesTheSideTheRayCameFrom) {
  const Vec3 below(0.3F, -1.0F, 0.2F);
  const Light above_light = point_light({0.0F, 2.0F, 0.0F}, Vec3(1.0F));
  const Light below_light = point_light({0.0F, -2.0F, 0.0F}, Vec3(1.0F));
  EXPECT_TRUE(shadow_ray(above_light));
  EXPECT_FALSE(shadow_ray(below_light));
  EXPECT_FALSE(shadow_ray(above_light, {}, below));
  const auto ray = shadow_ray(below_light, {}, below);
  ASSERT_TRUE(ray);
  EXPECT_LT(ray->origin.y, 0.0F);
}

TEST(ShadowRay, NeedsTheLightBeforeBothNormals) {
  const Vec3 tilted = glm::normalize(Vec3(1.0F, 0.5F, 0.0F));
  SceneBuilder b;
  b.material({});
  b.triangle({Vec3(0.0F), Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 0.0F, -1.0F)},
             {tilted, tilted, tilted});
  b.scene.lights = {point_light({-3.0F, 1.0F, 0.0F}, Vec3(1.0F)),  // behind the tilted normal
                    point_light({3.0F, -0.5F, 0.0F}, Vec3(1.0F)),  // below the floor
                    point_light({3.0F, 1.0F, 0.0F}, Vec3(1.0F))};
  const Shader shader(b.scene, {});
  const Ray ray = ray_between({1.0F, 1.0F, 0.0F}, Vec3(0.0F));
  const Surface s = shader.surface(ray, {1.0F, 0.0F, 0.0F, 0});
  Ray spawned;
  EXPECT_FALSE(shader.shadow(ray, s, 0, spawned));
  EXPECT_FALSE(shader.shadow(ray, s, 1, spawned));
  ASSERT_TRUE(shader.shadow(ray, s, 2, spawned));
  const float cosine = glm::dot(tilted, glm::normalize(Vec3(3.0F, 1.0F, 0.0F)));
  EXPECT_NEAR(spawned.weight.x, cosine / kPi / 10.0F, 1e-7F);
}

TEST(ShadowRay, FollowsADirectionalLightForEver) {
  Light sun;
  sun.type = Light::Type::kDirectional;
  sun.direction = glm::normalize(Vec3(-3.0F, -4.0F, 0.0F));
  sun.intensity = Vec3(10.0F);
  const auto ray = shadow_ray(sun);
  ASSERT_TRUE(ray);
  EXPECT_EQ(ray->t_max, kInfinity);
  EXPECT_EQ(ray->direction, -sun.direction);
  EXPECT_NEAR(ray->weight.x, 10.0F * 0.8F / kPi, 1e-6F);
}

TEST(ShadowRay, FadesBetweenTheConesOfASpot) {
  const auto at_angle = [](float degrees) {
    const float angle = degrees * kPi / 180.0F;
    return spot_light({2.0F * std::tan(angle), 2.0F, 0.0F});
  };
  const auto unattenuated = [](float degrees) {  // the cube of the cosine, by height squared
    return std::pow(std::cos(degrees * kPi / 180.0F), 3.0F) / 4.0F;
  };
  EXPECT_NEAR(irradiance(at_angle(10.0F)), unattenuated(10.0F), 1e-6F);
  EXPECT_NEAR(irradiance(at_angle(19.0F)), unattenuated(19.0F), 1e-6F);
  EXPECT_EQ(irradiance(at_angle(41.0F)), 0.0F);
  const auto cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); };
  const double ramp = (cosine(30.0) - cosine(40.0)) / (cosine(20.0) - cosine(40.0));
  EXPECT_NEAR(irradiance(at_angle(30.0F)), unattenuated(30.0F) * ramp * ramp, 1e-6);
}

TEST(ShadowRay, TakesASpotOfOneSharpCone) {
  Light light = spot_light({0.0F, 2.0F, 0.0F});
  light.cos_inner_cone = light.cos_outer_cone;
  EXPECT_NEAR(irradiance(light), 0.25F, 1e-6F);
  light.position.x = 3.0F;
  EXPECT_EQ(irradiance(light), 0.0F);
}

TEST(SpotAttenuation, IsNeverSteeperThanTheStandardAllows) {
  Light light = spot_light(Vec3(0.0F));
  light.cos_inner_cone = light.cos_outer_cone = 0.75F;
  EXPECT_EQ(spot_attenuation(light, 0.75F), 0.0F);
  EXPECT_NEAR(spot_attenuation(light, 0.7505F), 0.25F, 1e-3F);
  EXPECT_EQ(spot_attenuation(light, 0.752F), 1.0F);
}

TEST(ShadowRay, ShinesOnNothingBeyondItsRange) {
  Light light = point_light({0.0F, 2.0F, 0.0F}, Vec3(1.0F));
  light.range = 4.0F;
  EXPECT_NEAR(irradiance(light), 0.25F * (1.0F - 1.0F / 16.0F), 1e-6F);
  light.range = 2.0F;
  EXPECT_EQ(irradiance(light), 0.0F);
  light.range = 0.0F;
  EXPECT_NEAR(irradiance(light), 0.25F, 1e-6F);
}

TEST(ShadowRay, IsTaggedAsAChildOfItsRay) {
  Floor floor{Material{}};
  floor.builder.scene.lights.assign(3, point_light({0.0F, 2.0F, 0.0F}, Vec3(1.0F)));
  const Shader shader(floor.scene(), {});
  Ray ray = ray_between({0.3F, 1.0F, 0.2F}, Vec3(0.0F));
  ray.tag.depth = 4;  // far beyond the recursion level of 1
  Ray spawned;
  ASSERT_TRUE(shader.shadow(ray, shader.surface(ray, floor.hit), 2, spawned));
  EXPECT_EQ(spawned.tag.id, child_ray_id(ray.tag.id, 4));
  EXPECT_EQ(spawned.tag.pixel, ray.tag.pixel);
  EXPECT_EQ(spawned.tag.depth, 5);
  EXPECT_EQ(spawned.tag.kind, RayKind::kShadow);
}

TEST(ShadowRay, NeedsADiffuseSurface) {
  const Light light = point_light({0.0F, 2.0F, 0.0F}, Vec3(1.0F));
  Material m;
  m.diffuse_weight = 0.0F;
  EXPECT_FALSE(shadow_ray(light, m));
  m.diffuse_weight = 1.0F;
  m.unlit = true;
  EXPECT_FALSE(shadow_ray(light, m));
  m.unlit = false;
  m.base_color = Vec3(0.0F);
  EXPECT_FALSE(shadow_ray(light, m));
}

TEST(ShadowRay, IsNotSpawnedAtOrBelowTheCutoff) {
  const Light light = point_light({0.0F, 1.0F, 0.0F}, {1.0F, 2.0F, 0.5F});
  const auto weight = shadow_ray(light)->weight;
  const auto spawned = [&](float cutoff) {
    return shadow_ray(light, {}, {0.3F, 1.0F, 0.2F}, {1, cutoff}).has_value();
  };
  EXPECT_FALSE(spawned(weight.y));
  EXPECT_TRUE(spawned(std::nextafter(weight.y, 0.0F)));
}

TEST(ShadowRay, DoesNotExistForALightInTheSurface) {
  EXPECT_FALSE(shadow_ray(point_light(Vec3(0.0F), Vec3(1.0F))));
  EXPECT_FALSE(shadow_ray(point_light(offset_origin(Vec3(0.0F), {0.0F, 1.0F, 0.0F}), Vec3(1.0F))));
}

TEST(ShadowRay, DoesNotExistAtDistancesThatFloatsCannotSquare) {
  EXPECT_FALSE(shadow_ray(point_light({1e-22F, 1e-22F, 0.0F}, Vec3(1.0F))));
  EXPECT_FALSE(shadow_ray(point_light({0.0F, 1e20F, 0.0F}, Vec3(1e38F))));
}

TEST(ShadowRay, SaturatesInsteadOfOverflowing) {
  const auto ray = shadow_ray(point_light({0.0F, 1e-6F, 0.0F}, Vec3(1e30F)));
  ASSERT_TRUE(ray);
  EXPECT_EQ(ray->weight, Vec3(kFloatMax));
}

TEST(ShadowRay, KeepsTinyWeightsUnderBrightCloseLights) {
  Floor floor{Material{}};
  floor.builder.scene.lights = {point_light({0.0F, 1e-3F, 0.0F}, Vec3(1e30F))};
  const Shader shader(floor.scene(), {});
  Ray ray = ray_between({0.3F, 1.0F, 0.2F}, Vec3(0.0F));
  ray.weight = Vec3(1e-35F);
  Ray spawned;
  ASSERT_TRUE(shader.shadow(ray, shader.surface(ray, floor.hit), 0, spawned));
  EXPECT_NEAR(spawned.weight.x, 10.0F / kPi, 1e-5F);
}

}  // namespace
}  // namespace sheaf::test
