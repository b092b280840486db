// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "gltf_builder.h"

namespace sheaf::test {
namespace {

/// The one material of a scene whose triangle uses `material`.
Material load_material(const json& material, const SceneLoadOptions& options = {}) {
  GltfBuilder file = one_triangle();
  file.root["materials"] = json::array({material});
  file.root["meshes"][0]["primitives"][0]["material"] = 0;
  const Scene scene = load(file, options).scene;
  EXPECT_EQ(scene.materials.size(), 1U);
  return scene.materials.at(0);
}

json pbr(double metallic, double roughness) {
  return {{"pbrMetallicRoughness",
           {{"baseColorFactor", {0.5, 0.25, 1, 1}},
            {"metallicFactor", metallic},
            {"roughnessFactor", roughness}}}};
}

json with_extension(json material, const char* name, const json& members) {
  material["extensions"][name] = members;
  return material;
}

TEST(LoadMaterial, SmoothMetalIsATintedMirror) {
  const Material m = load_material(pbr(1, 0));
  EXPECT_EQ(m.mirror_weight, 1.0F);
  EXPECT_TRUE(m.mirror_tinted);
  EXPECT_EQ(m.diffuse_weight, 0.0F);
  EXPECT_EQ(m.base_color, Vec3(0.5F, 0.25F, 1));
  EXPECT_TRUE(m.reflects());
  EXPECT_FALSE(m.refracts());
}

TEST(LoadMaterial, HalfMetalIsHalfAMirrorUpToTheRoughnessLimit) {
  const Material m = load_material(pbr(0.75, 0.1));
  EXPECT_EQ(m.mirror_weight, 0.75F);
  EXPECT_EQ(m.diffuse_weight, 0.25F);
}

TEST(LoadMaterial, RougherMetalIsDiffuse) {
  const Material m = load_material(pbr(1, 0.11));
  EXPECT_EQ(m.mirror_weight, 0.0F);
  EXPECT_EQ(m.diffuse_weight, 1.0F);
  EXPECT_FALSE(m.reflects());
}

TEST(LoadMaterial, WithoutMaterialTheDefaultIsWhiteAndDiffuse) {
  const Scene scene = load(one_triangle()).scene;
  ASSERT_EQ(scene.materials.size(), 1U);
  EXPECT_EQ(scene.materials[0].diffuse_weight, 1.0F);
  EXPECT_EQ(scene.materials[0].base_color, Vec3(1));
}

TEST(LoadMaterial, TransmissionAndIorWithIntegersInTheFile) {
  json glass = with_extension(pbr(0, 0), "KHR_materials_transmission", {{"transmissionFactor", 1}});
  glass = with_extension(glass, "KHR_materials_ior", {{"ior", 2}});
  const Material m = load_material(glass);
  EXPECT_EQ(m.transmission, 1.0F);
  EXPECT_EQ(m.diffuse_weight, 0.0F);
  EXPECT_EQ(m.ior, 2.0F);
  EXPECT_TRUE(m.refracts());
  EXPECT_TRUE(m.reflects());
}

TEST(LoadMaterial, IorDefaultsToOneAndAHalf) {
  EXPECT_EQ(load_material(pbr(0, 1)).ior, 1.5F);
  EXPECT_EQ(load_material(with_extension(pbr(0, 1), "KHR_materials_ior", json::object())).ior,
            1.5F);
}

TEST(LoadMaterial, WeightsSumToOne) {
  for (const double metallic : {0.0, 0.25, 1.0}) {
    for (const double roughness : {0.0, 0.5}) {
      const Material m = load_material(with_extension(
          pbr(metallic, roughness), "KHR_materials_transmission", {{"transmissionFactor", 0.5}}));
      EXPECT_FLOAT_EQ(m.mirror_weight + m.diffuse_weight + m.transmission, 1.0F);
      EXPECT_EQ(m.transmission, static_cast<float>(0.5 * (1 - metallic)));
    }
  }
}

TEST(LoadMaterial, EmissiveStrengthMultipliesTheFactor) {
  json lamp = pbr(0, 1);
  lamp["emissiveFactor"] = {1, 0.5, 0};
  EXPECT_EQ(load_material(lamp).emission, Vec3(1, 0.5F, 0));
  lamp = with_extension(lamp, "KHR_materials_emissive_strength", {{"emissiveStrength", 8}});
  EXPECT_EQ(load_material(lamp).emission, Vec3(8, 4, 0));
  lamp["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 5'000'000'000;
  EXPECT_EQ(load_material(lamp).emission, Vec3(5e9F, 2.5e9F, 0));
}

TEST(LoadMaterial, UnlitSpawnsNothing) {
  const Material m =
      load_material(with_extension(pbr(1, 0), "KHR_materials_unlit", json::object()));
  EXPECT_TRUE(m.unlit);
  EXPECT_EQ(m.base_color, Vec3(0.5F, 0.25F, 1));
  EXPECT_FALSE(m.reflects() || m.refracts() || m.diffuse());
}

TEST(LoadMaterial, ReflectanceReplacesTheMirrorPart) {
  const SceneLoadOptions half{.reflectance = 0.5F};
  for (const json& source : {pbr(0, 1), pbr(1, 0)}) {
    const Material m = load_material(source, half);
    EXPECT_EQ(m.mirror_weight, 0.5F);
    EXPECT_FALSE(m.mirror_tinted);
    EXPECT_EQ(m.diffuse_weight, 0.5F);
  }
  const Material none = load_material(pbr(1, 0), {.reflectance = 0.0F});
  EXPECT_FALSE(none.reflects());
  EXPECT_EQ(none.diffuse_weight, 1.0F);
}

TEST(LoadMaterial, ReflectanceScalesTransmission) {
  const Material m = load_material(
      with_extension(pbr(0, 1), "KHR_materials_transmission", {{"transmissionFactor", 0.5}}),
      {.reflectance = 0.5F});
  EXPECT_EQ(m.transmission, 0.25F);
  EXPECT_EQ(m.diffuse_weight, 0.25F);
}

TEST(LoadMaterial, ReflectanceTurnsUnlitIntoALight) {
  const Material m = load_material(with_extension(pbr(0, 1), "KHR_materials_unlit", json::object()),
                                   {.reflectance = 0.5F});
  EXPECT_TRUE(m.reflects());
  EXPECT_EQ(m.mirror_weight, 0.5F);
  EXPECT_EQ(m.emission, Vec3(0.25F, 0.125F, 0.5F));
  EXPECT_FALSE(m.diffuse());
}

TEST(LoadMaterial, OnlyUsedMaterialsAreKept) {
  GltfBuilder file = one_triangle();
  file.root["materials"] = json::array({pbr(1, 0), pbr(0, 1)});
  file.root["materials"][1]["name"] = "used";
  file.root["meshes"][0]["primitives"][0]["material"] = 1;
  // A mesh that no node places uses the mirror.
  file.add_mesh({{"POSITION", 0}}, -1, 0);
  const Scene scene = load(file).scene;
  ASSERT_EQ(scene.materials.size(), 1U);
  EXPECT_EQ(scene.materials[0].name, "used");
  EXPECT_FALSE(scene.needs.reflection);
}

TEST(LoadMaterial, TrianglesKnowTheirMaterial) {
  GltfBuilder file = one_triangle();
  file.root["materials"] = json::array({pbr(1, 0), pbr(0, 1)});
  file.root["meshes"][0]["primitives"][0]["material"] = 1;
  file.add_root({{"mesh", file.add_mesh({{"POSITION", 0}}, -1, 0)}});
  const Scene scene = load(file).scene;
  ASSERT_EQ(scene.triangle_material.size(), 2U);
  EXPECT_FALSE(scene.materials[scene.triangle_material[0]].reflects());
  EXPECT_TRUE(scene.materials[scene.triangle_material[1]].reflects());
}

TEST(LoadMaterial, AlphaIsOpaqueWithAWarning) {
  GltfBuilder file = one_triangle();
  file.root["materials"] = json::array({{{"alphaMode", "MASK"}}});
  file.root["meshes"][0]["primitives"][0]["material"] = 0;
  const LoadedScene loaded = load(file, {.light_position = Vec3(1)});
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_NE(loaded.warnings[0].find("opaque"), std::string::npos);
}

TEST(LoadMaterial, NamesCannotBreakALine) {
  json m = pbr(0, 1);
  m["name"] = "a\nb\x1b[31m";
  EXPECT_EQ(load_material(m).name, "a?b?[31m");
}

}  // namespace
}  // namespace sheaf::test
