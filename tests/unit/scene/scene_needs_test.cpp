// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_needs.h"

#include <gtest/gtest.h>

namespace sheaf {
namespace {

/// A scene whose triangles use the first material; the second is there but unused.
Scene scene_of(const Material& used, const Material& unused, bool lit) {
  Scene scene;
  scene.materials = {used, unused};
  scene.triangle_material = {0, 0};
  if (lit) scene.lights.emplace_back();
  return scene;
}

Material glass() {
  Material m;
  m.diffuse_weight = 0.0F;
  m.transmission = 1.0F;
  return m;
}

Material mirror() {
  Material m;
  m.diffuse_weight = 0.0F;
  m.mirror_weight = 1.0F;
  return m;
}

TEST(SceneNeeds, DiffuseUnderALightNeedsShadowsOnly) {
  EXPECT_EQ(make_needs(scene_of(Material(), Material(), true)), (SceneNeeds{.lights = true}));
}

TEST(SceneNeeds, DiffuseWithoutLightNeedsNothing) {
  EXPECT_EQ(make_needs(scene_of(Material(), Material(), false)), SceneNeeds());
}

TEST(SceneNeeds, MirrorUnderALightNeedsNoShadows) {
  EXPECT_EQ(make_needs(scene_of(mirror(), Material(), true)), (SceneNeeds{.reflection = true}));
}

TEST(SceneNeeds, GlassReflectsAndRefracts) {
  EXPECT_EQ(make_needs(scene_of(glass(), Material(), false)),
            (SceneNeeds{.reflection = true, .refraction = true}));
  Material veil = glass();
  veil.ior = 1.0F;
  EXPECT_EQ(make_needs(scene_of(veil, Material(), false)), (SceneNeeds{.refraction = true}));
}

TEST(SceneNeeds, UnusedMaterialsDoNotCount) {
  Material textured = mirror();
  textured.base_color_texture = 0;
  EXPECT_EQ(make_needs(scene_of(Material(), textured, false)), SceneNeeds());
  EXPECT_EQ(make_needs(scene_of(Material(), glass(), false)), SceneNeeds());
}

TEST(SceneNeeds, EitherTextureCounts) {
  Material m;
  m.base_color_texture = 0;
  EXPECT_TRUE(make_needs(scene_of(m, Material(), false)).textures);
  m = Material();
  m.emission_texture = 0;
  EXPECT_TRUE(make_needs(scene_of(m, Material(), false)).textures);
}

TEST(SceneNeeds, UnlitNeedsNothing) {
  Material m = mirror();
  m.unlit = true;
  EXPECT_EQ(make_needs(scene_of(m, Material(), true)), SceneNeeds());
}

}  // namespace
}  // namespace sheaf
