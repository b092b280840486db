// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf_builder.h"

namespace sheaf::test {
namespace {

constexpr const char* kPunctual = "KHR_lights_punctual";

GltfBuilder lit_by(const json& light, json node) {
  GltfBuilder file = one_triangle();
  file.root["extensionsUsed"] = {kPunctual};
  file.root["extensions"] = {{kPunctual, {{"lights", json::array({light})}}}};
  node["extensions"] = {{kPunctual, {{"light", 0}}}};
  file.add_root(node);
  return file;
}

TEST(LoadLight, PointLightWithIntegersInTheFile) {
  const Scene scene =
      load(lit_by({{"type", "point"}, {"intensity", 40}, {"color", {1, 0.5, 0}}, {"range", 7}},
                  {{"translation", {1, 2, 3}}}))
          .scene;
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].type, Light::Type::kPoint);
  EXPECT_EQ(scene.lights[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(scene.lights[0].intensity, Vec3(40, 20, 0));
  EXPECT_EQ(scene.lights[0].range, 7.0F);
  EXPECT_TRUE(scene.needs.lights);
}

TEST(LoadLight, DirectionalLightShinesAlongItsNodesMinusZ) {
  // Turned by -90 degrees about x, -z becomes -y; scale does not change the direction.
  const double h = std::sqrt(0.5);
  const Scene scene =
      load(lit_by({{"type", "directional"}}, {{"rotation", {-h, 0, 0, h}}, {"scale", {3, 3, 3}}}))
          .scene;
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].type, Light::Type::kDirectional);
  EXPECT_LT(glm::distance(scene.lights[0].direction, Vec3(0, -1, 0)), 1e-6F);
  EXPECT_EQ(scene.lights[0].intensity, Vec3(1));
}

TEST(LoadLight, SpotLightHasItsConesCosines) {
  const Scene scene =
      load(lit_by({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 1}}}},
                  json::object()))
          .scene;
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].type, Light::Type::kSpot);
  EXPECT_FLOAT_EQ(scene.lights[0].cos_inner_cone, std::cos(0.25F));
  EXPECT_FLOAT_EQ(scene.lights[0].cos_outer_cone, std::cos(1.0F));
  EXPECT_EQ(scene.lights[0].direction, Vec3(0, 0, -1));
}

TEST(LoadLight, LightThatNoNodePlacesIsNotThere) {
  GltfBuilder file = lit_by({{"type", "point"}}, json::object());
  file.root["nodes"][1].erase("extensions");
  const LoadedScene loaded = load(file);
  EXPECT_TRUE(loaded.scene.lights.empty());
  EXPECT_FALSE(loaded.scene.needs.lights);
}

TEST(LoadLight, ABlackLightIsDropped) {
  const LoadedScene loaded = load(lit_by({{"type", "point"}, {"intensity", 0}}, json::object()));
  EXPECT_TRUE(loaded.scene.lights.empty());
  EXPECT_FALSE(loaded.warnings.empty());
}

TEST(LoadLight, ConfiguredLightReplacesAllOthers) {
  const SceneLoadOptions options{.light_position = Vec3(0, 0, 4), .light_intensity = 12.0F};
  const Scene scene =
      load(lit_by({{"type", "directional"}}, {{"translation", {9, 9, 9}}}), options).scene;
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].type, Light::Type::kPoint);
  EXPECT_EQ(scene.lights[0].position, Vec3(0, 0, 4));
  EXPECT_EQ(scene.lights[0].intensity, Vec3(12));
}

TEST(LoadLight, ConfiguredLightWithoutIntensityGivesIrradiancePiAtTheCentre) {
  // The triangle's bounds have their centre at (0.5, 0.5, 0).
  const Scene scene =
      load(one_triangle(), SceneLoadOptions{.light_position = Vec3(0.5F, 0.5F, 3)}).scene;
  EXPECT_FLOAT_EQ(scene.lights.at(0).intensity.x / 9.0F, std::numbers::pi_v<float>);
  const Scene inside =
      load(one_triangle(), SceneLoadOptions{.light_position = Vec3(0.5F, 0.5F, 0)}).scene;
  EXPECT_GT(inside.lights.at(0).intensity.x, 0.0F);
}

TEST(LoadLight, ASceneWithoutLightWarns) {
  const LoadedScene dark = load(one_triangle());
  ASSERT_EQ(dark.warnings.size(), 1U);
  EXPECT_NE(dark.warnings[0].find("black"), std::string::npos);
  EXPECT_TRUE(load(one_triangle(), {.light_position = Vec3(1)}).warnings.empty());
}

}  // namespace
}  // namespace sheaf::test
