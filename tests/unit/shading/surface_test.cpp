// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>

#include "scene_builder.h"
#include "shading/shader.h"

namespace sheaf::test {
namespace {

const Vec3 kUp(0.0F, 1.0F, 0.0F);
constexpr Hit kQuarter{1.0F, 0.25F, 0.25F, 0};

TEST(Surface, LiesOnTheTriangleWhereBarycentricsSay) {
  const Floor floor{Material{}};
  const Shader shader(floor.scene(), {});
  const Surface s = shader.surface(ray_between({0.5F, 2.0F, 1.0F}, Vec3(0.0F)), floor.hit);
  EXPECT_EQ(s.position, Vec3(0.0F));
  EXPECT_EQ(s.geometric_normal, kUp);
  EXPECT_EQ(s.shading_normal, kUp);
  EXPECT_TRUE(s.entering);
  EXPECT_EQ(s.num_texels, 0);
}

TEST(Surface, DoesNotInheritTheErrorOfADistantOrigin) {
  const Floor floor{Material{}};
  const Shader shader(floor.scene(), {});
  Ray ray = ray_between({311111.7F, 7777777.0F, 123456.7F}, Vec3(0.0F));
  Hit hit = floor.hit;
  hit.t = glm::length(ray.origin);
  EXPECT_GT(glm::length(ray.origin + hit.t * ray.direction), 1e-3F);  // what t alone would give
  EXPECT_EQ(shader.surface(ray, hit).position, Vec3(0.0F));
}

TEST(Surface, TurnsBothNormalsToTheSideTheRayCameFrom) {
  const Floor floor{Material{}};
  const Shader shader(floor.scene(), {});
  const Surface s = shader.surface(ray_between({0.5F, -2.0F, 1.0F}, Vec3(0.0F)), floor.hit);
  EXPECT_EQ(s.geometric_normal, -kUp);
  EXPECT_EQ(s.shading_normal, -kUp);
  EXPECT_FALSE(s.entering);
}

TEST(Surface, InterpolatesNormals) {
  SceneBuilder b;
  b.material({});
  const Vec3 na = glm::normalize(Vec3(-0.1F, 1.0F, 0.0F));
  const Vec3 nb = glm::normalize(Vec3(0.4F, 1.0F, 0.0F));
  const Vec3 nc = glm::normalize(Vec3(0.0F, 1.0F, 0.3F));
  b.triangle({Vec3(0.0F), Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 0.0F, -1.0F)}, {na, nb, nc});
  const Shader shader(b.scene, {});
  const Surface s = shader.surface(ray_between({0.0F, 1.0F, 0.0F}, Vec3(0.0F)), kQuarter);
  const Vec3 expected = glm::normalize(0.5F * na + 0.25F * nb + 0.25F * nc);
  EXPECT_LT(glm::length(s.shading_normal - expected), 2e-7F);
  EXPECT_EQ(s.geometric_normal, kUp);
}

TEST(Surface, BringsAnInterpolatedNormalOfTheOtherSideToTheGeometricOne) {
  SceneBuilder b;
  b.material({});
  const Vec3 n = glm::normalize(Vec3(0.3F, -1.0F, 0.0F));  // against the winding
  b.triangle({Vec3(0.0F), Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 0.0F, -1.0F)}, {n, n, n});
  const Shader shader(b.scene, {});
  for (const float side : {1.0F, -1.0F}) {
    const Surface s = shader.surface(ray_between({0.0F, side, 0.0F}, Vec3(0.0F)), kQuarter);
    EXPECT_EQ(s.geometric_normal, side * kUp);
    EXPECT_LT(glm::length(s.shading_normal + side * n), 2e-7F);
  }
}

TEST(Surface, FallsBackToTheGeometricNormal) {
  SceneBuilder b;
  b.material({});
  const Vec3 n(1.0F, 0.0F, 0.0F);
  b.triangle({Vec3(0.0F), Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 0.0F, -1.0F)}, {n, -n, -n});
  const Shader shader(b.scene, {});  // the three cancel at u = v = 1/4
  const Surface s = shader.surface(ray_between({0.0F, 1.0F, 0.0F}, Vec3(0.0F)), kQuarter);
  EXPECT_EQ(s.shading_normal, kUp);
}

TEST(Surface, FindsTheNormalOfTinyAndHugeTriangles) {
  for (const float size : {1e-17F, 1e-12F, 1e-6F, 1.0F, 1e6F, 1e10F, 1e18F}) {
    SceneBuilder b;
    b.material({});
    b.triangle({Vec3(0.0F), Vec3(size, 0.0F, 0.0F), Vec3(0.0F, 0.0F, -size)}, {kUp, kUp, kUp});
    const Shader shader(b.scene, {});
    // A ray that is far from parallel to the normal tells a real normal from the fallback.
    const Surface s = shader.surface(ray_between({-5.0F, 1.0F, 0.0F}, Vec3(0.0F)), kQuarter);
    EXPECT_LT(glm::length(s.geometric_normal - kUp), 1e-6F) << size;
  }
}

TEST(Surface, FacesTheRayWhereATriangleHasNoArea) {
  SceneBuilder b;
  b.material({});
  b.triangle({Vec3(1.0F), Vec3(1.0F), Vec3(1.0F)}, {Vec3(0.0F), Vec3(0.0F), Vec3(0.0F)});
  const Shader shader(b.scene, {});
  const Ray ray = ray_between({0.0F, 3.0F, 0.5F}, Vec3(1.0F));
  const Surface s = shader.surface(ray, kQuarter);
  EXPECT_EQ(s.position, Vec3(1.0F));
  EXPECT_EQ(s.geometric_normal, -ray.direction);
  EXPECT_EQ(s.shading_normal, -ray.direction);
}

/// A 2 × 2 texture of black, red, green and blue texels.
Texture four_colors() {
  Texture t;
  t.width = 2;
  t.height = 2;
  t.rgba = {0, 0, 0, 255, 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255};
  return t;
}

TEST(Surface, MultipliesColoursByTheirTexturesAndRecordsTheTexels) {
  SceneBuilder b;
  b.scene.textures = {four_colors(), four_colors()};
  b.scene.textures[1].nearest = true;
  Material m;
  m.base_color = Vec3(0.5F);
  m.base_color_texture = 0;
  m.emission = Vec3(4.0F);
  m.emission_texture = 1;
  b.material(m);
  b.triangle({Vec3(0.0F), Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 0.0F, -1.0F)}, {kUp, kUp, kUp}, 0,
             {Vec2(0.5F, 0.0F), Vec2(1.0F, 1.0F), Vec2(0.0F, 1.0F)});
  const Shader shader(b.scene, {});
  // u = v = 1/4 gives uv = (0.5, 0.5): the middle of the four texels.
  const Surface s = shader.surface(ray_between({0.0F, 1.0F, 0.0F}, Vec3(0.0F)), kQuarter);
  EXPECT_LT(glm::length(s.base_color - Vec3(0.125F)), 1e-6F);
  EXPECT_EQ(s.emission, Vec3(0.0F, 0.0F, 4.0F));
  ASSERT_EQ(s.num_texels, 5);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(s.texels[i].texture, 0U);
    EXPECT_EQ(s.texels[i].x, i % 2);
    EXPECT_EQ(s.texels[i].y, i / 2);
  }
  EXPECT_EQ(s.texels[4].texture, 1U);
  EXPECT_EQ(s.texels[4].x, 1U);
  EXPECT_EQ(s.texels[4].y, 1U);
}

TEST(Shader, EmitsWeightTimesEmissionOrTheUnlitColour) {
  Material m;
  m.emission = Vec3(2.0F, 3.0F, 4.0F);
  m.base_color = Vec3(0.25F);
  for (const bool unlit : {false, true}) {
    m.unlit = unlit;
    const Floor floor{m};
    const Shader shader(floor.scene(), {});
    Ray ray = ray_between({0.0F, 1.0F, 0.0F}, Vec3(0.0F));
    ray.weight = Vec3(0.5F, 1.0F, 2.0F);
    const Surface s = shader.surface(ray, floor.hit);
    EXPECT_EQ(shader.emitted(ray, s), unlit ? Vec3(0.125F, 0.25F, 0.5F) : Vec3(1.0F, 3.0F, 8.0F));
  }
}

TEST(Shader, GivesRaysThatLeaveTheSceneItsBackground) {
  Floor floor{Material{}};
  floor.builder.scene.background = Vec3(0.5F, 1e30F, 0.0F);
  const Shader shader(floor.scene(), {});
  Ray ray = ray_between({0.0F, 1.0F, 0.0F}, Vec3(0.0F));
  ray.weight = Vec3(0.5F, 1e30F, 1.0F);
  EXPECT_EQ(shader.missed(ray), Vec3(0.25F, std::numeric_limits<float>::max(), 0.0F));
}

TEST(Shader, RefusesScenesThatBreakTheirContract) {
  Material m;
  m.name = "odd";
  m.base_color_texture = 0;
  EXPECT_THROW(Shader(Floor{m}.scene(), {}), std::logic_error) << "no such texture";
  Floor short_of_texels{m};
  short_of_texels.builder.scene.textures = {four_colors()};
  EXPECT_NO_THROW(Shader(short_of_texels.scene(), {}));
  short_of_texels.builder.scene.textures[0].rgba.pop_back();
  EXPECT_THROW(Shader(short_of_texels.scene(), {}), std::logic_error);
  Floor without_uvs{m};
  without_uvs.builder.scene.textures = {four_colors()};
  without_uvs.builder.scene.uvs.clear();
  EXPECT_THROW(Shader(without_uvs.scene(), {}), std::logic_error);
  Material thin;
  thin.ior = 0.5F;
  EXPECT_THROW(Shader(Floor{thin}.scene(), {}), std::logic_error);
}

}  // namespace
}  // namespace sheaf::test
