// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The float shader against the double-precision reference on whole pictures of a small scene that
// has everything: mirrors, glass, textures, all kinds of lights, several levels of recursion.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "middle_split_tree.h"
#include "scene_builder.h"
#include "shading/reference.h"
#include "shading/reference_hit.h"
#include "shading/shader.h"

namespace sheaf::test {
namespace {

constexpr std::uint32_t kWidth = 64;
constexpr std::uint32_t kHeight = 48;

Texture noise_texture() {
  Random random(1);
  Texture t;
  t.width = 16;
  t.height = 8;
  t.wrap_v = Texture::Wrap::kMirroredRepeat;
  for (std::uint32_t i = 0; i < t.width * t.height * 4; ++i) {
    t.rgba.push_back(static_cast<std::uint8_t>(random.below(256)));
  }
  return t;
}

void add_lights(Scene& scene) {
  Light point;
  point.position = {-2.0F, 3.0F, 1.0F};
  point.intensity = {20.0F, 25.0F, 30.0F};
  point.range = 20.0F;
  Light spot;
  spot.type = Light::Type::kSpot;
  spot.position = {2.0F, 4.0F, 2.0F};
  spot.direction = glm::normalize(Vec3(-0.4F, -1.0F, -0.6F));
  spot.intensity = {60.0F, 50.0F, 40.0F};
  spot.cos_inner_cone = 0.95F;
  spot.cos_outer_cone = 0.8F;
  Light sun;
  sun.type = Light::Type::kDirectional;
  sun.direction = glm::normalize(Vec3(0.3F, -1.0F, -0.2F));
  sun.intensity = Vec3(1.0F);
  scene.lights = {point, spot, sun};
}

Scene gallery() {
  SceneBuilder b;
  b.scene.textures = {noise_texture()};
  Material floor;
  floor.base_color_texture = 0;
  floor.mirror_weight = 0.3F;
  floor.mirror_tinted = false;
  Material metal;
  metal.base_color = {0.9F, 0.7F, 0.3F};
  metal.mirror_weight = 1.0F;
  metal.diffuse_weight = 0.0F;
  Material glass;
  glass.base_color = {0.9F, 1.0F, 0.95F};
  glass.transmission = 0.9F;
  glass.diffuse_weight = 0.1F;
  Material lamp;
  lamp.emission = {1.0F, 0.5F, 0.25F};
  lamp.emission_texture = 0;
  const auto floor_index = b.material(floor);
  const auto metal_index = b.material(metal);
  const auto glass_index = b.material(glass);
  const auto lamp_index = b.material(lamp);

  const Vec3 up(0.0F, 1.0F, 0.0F);
  b.triangle({Vec3(-6.0F, -1.0F, 4.0F), Vec3(6.0F, -1.0F, 4.0F), Vec3(6.0F, -1.0F, -8.0F)},
             {up, up, up}, floor_index, {Vec2(-1.0F, 0.0F), Vec2(2.0F, 0.0F), Vec2(2.0F, 3.0F)});
  b.triangle({Vec3(-6.0F, -1.0F, 4.0F), Vec3(6.0F, -1.0F, -8.0F), Vec3(-6.0F, -1.0F, -8.0F)},
             {up, up, up}, floor_index, {Vec2(-1.0F, 0.0F), Vec2(2.0F, 3.0F), Vec2(-1.0F, 3.0F)});
  b.sphere({-1.1F, 0.0F, -4.0F}, 1.0F, 16, metal_index);
  b.sphere({1.1F, 0.0F, -3.5F}, 1.0F, 16, glass_index);
  b.quad({-3.1F, 0.05F, -6.0F}, {6.3F, 0.0F, 0.3F}, {0.1F, 2.0F, 0.0F}, lamp_index);
  add_lights(b.scene);
  b.scene.background = {0.2F, 0.3F, 0.5F};
  b.scene.camera.half_height = 0.5F;
  return b.scene;
}

/// A picture by Shader, one ray at a time. Hits are found in double precision along the float rays,
/// so that what differs from the reference is the shader's doing.
class ShaderPicture {
 public:
  ShaderPicture(const Scene& scene, const KdTree& tree, std::uint32_t recursion_level)
      : scene_(scene), tree_(tree), shader_(scene, {recursion_level, 0.0F}) {}

  [[nodiscard]] Vec3d pixel(std::uint32_t x, std::uint32_t y) const {
    const Camera& camera = scene_.camera;
    const float across = (2.0F * (static_cast<float>(x) + 0.5F) / kWidth - 1.0F) *
                         camera.half_height * kWidth / kHeight;
    const float up = (1.0F - 2.0F * (static_cast<float>(y) + 0.5F) / kHeight) * camera.half_height;
    const Vec3 aim = camera.forward + across * camera.right + up * camera.up;
    return trace(ray_between(camera.position, camera.position + aim));
  }

 private:
  [[nodiscard]] Vec3d trace(const Ray& ray) const {
    const ReferenceRay wide{Vec3d(ray.origin), Vec3d(ray.direction)};
    const auto found = reference_closest_hit(scene_, tree_, wide);
    if (!found) return Vec3d(shader_.missed(ray));
    const Hit hit{static_cast<float>(found->t), static_cast<float>(found->u),
                  static_cast<float>(found->v), found->triangle};
    const Surface surface = shader_.surface(ray, hit);
    Vec3d sum(shader_.emitted(ray, surface));
    Ray spawned;
    for (std::uint32_t light = 0; light < scene_.lights.size(); ++light) {
      if (!shader_.shadow(ray, surface, light, spawned)) continue;
      const ReferenceRay shadow{Vec3d(spawned.origin), Vec3d(spawned.direction),
                                static_cast<double>(spawned.t_max)};
      if (!reference_occluded(scene_, tree_, shadow)) sum += Vec3d(spawned.weight);
    }
    if (shader_.reflect(ray, surface, spawned)) sum += trace(spawned);
    if (shader_.refract(ray, surface, spawned)) sum += trace(spawned);
    return sum;
  }

  const Scene& scene_;
  const KdTree& tree_;
  Shader shader_;
};

/// Largest difference of any channel of any pixel between shader and reference.
double largest_difference(std::uint32_t recursion_level) {
  const Scene scene = gallery();
  const KdTree tree = MiddleSplitTree(scene).tree;
  const ReferenceTracer reference(scene, tree, {kWidth, kHeight, recursion_level});
  const ShaderPicture picture(scene, tree, recursion_level);
  double largest = 0.0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const Vec3d d = glm::abs(picture.pixel(x, y) - reference.pixel(x, y));
      EXPECT_FALSE(std::isnan(d.x + d.y + d.z));
      largest = std::max({largest, d.x, d.y, d.z});
    }
  }
  return largest;
}

// Pixels reach about 3. What is seen directly is some ulps off; curved mirrors and glass magnify
// the rounding of a direction about tenfold a bounce, until the weights of further bounces fall as
// fast. How much they magnify depends on where each ray meets them, so that no bound for the
// picture follows: these are thrice what was seen (1.3e-6, 2.9e-5, 2.8e-4, 2.8e-4), to tell when it
// grows.
TEST(AgreementRegression, StaysSomeUlpsWithoutBounces) {
  EXPECT_LT(largest_difference(0), 4e-6);
}
TEST(AgreementRegression, StaysAsItWasAfterOneBounce) {
  EXPECT_LT(largest_difference(1), 9e-5);
}
TEST(AgreementRegression, StaysAsItWasAfterTwoBounces) {
  EXPECT_LT(largest_difference(2), 9e-4);
}
TEST(AgreementRegression, StaysAsItWasAfterFourBounces) {
  EXPECT_LT(largest_difference(4), 9e-4);
}

}  // namespace
}  // namespace sheaf::test
