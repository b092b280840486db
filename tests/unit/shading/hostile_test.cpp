// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Whatever a scene holds that the loader lets through, no NaN and no infinity may leave the shader.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "scene_builder.h"
#include "shading/shader.h"

namespace sheaf::test {
namespace {

constexpr float kFloatMax = std::numeric_limits<float>::max();

class Hostile {
 public:
  explicit Hostile(std::uint64_t seed) : random_(seed) {}

  float pick(const auto& values) { return values[random_.below(std::size(values))]; }
  float coordinate() {
    constexpr float kValues[] = {0.0F,  -0.0F, 1e-45F, -1e-38F, 1e-19F, 1e-6F, 0.5F,
                                 -1.0F, 1.0F,  3.0F,   -1e3F,   1e6F,   -1e9F, 1e17F};
    return pick(kValues);
  }
  float share() {
    constexpr float kValues[] = {0.0F, 1e-45F, 1e-7F, 0.3F, 0.999999F, 1.0F};
    return pick(kValues);
  }
  float amount() {
    constexpr float kValues[] = {0.0F, 1e-45F, 1e-38F, 1e-30F, 0.001F, 1.0F, 1e30F, kFloatMax};
    return pick(kValues);
  }
  Vec3 point() {
    return vec([this] { return coordinate(); });
  }
  Vec3 shares() {
    return vec([this] { return share(); });
  }
  Vec3 amounts() {
    return vec([this] { return amount(); });
  }
  Vec3 direction() {
    const Vec3d v(point());
    const double length = glm::length(v);
    return length > 0.0 ? Vec3(v / length) : Vec3(0.0F, 0.0F, 1.0F);
  }
  bool coin() { return random_.below(2) != 0; }
  std::uint64_t below(std::uint64_t bound) { return random_.below(bound); }

 private:
  Vec3 vec(auto&& component) {
    const float x = component();
    const float y = component();
    return {x, y, component()};
  }
  Random random_;
};

Material hostile_material(Hostile& h) {
  Material m;
  m.base_color = h.shares();
  m.emission = h.amounts();
  m.diffuse_weight = h.share();
  m.mirror_weight = h.share();
  m.mirror_tinted = h.coin();
  m.transmission = h.share();
  constexpr float kIors[] = {1.0F, 1.0000001F, 1.5F, 100.0F, 1e30F};
  m.ior = h.pick(kIors);
  m.base_color_texture = h.coin() ? 0 : kNoTexture;
  return m;
}

Light hostile_light(Hostile& h) {
  Light light;
  light.type = static_cast<Light::Type>(h.below(3));
  light.position = h.point();
  light.direction = h.direction();
  light.intensity = h.amounts();
  light.range = h.amount();
  light.cos_inner_cone = h.share();
  light.cos_outer_cone = std::min(light.cos_inner_cone, h.share());
  return light;
}

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A weight that a film takes.
bool acceptable(const Vec3& w) {
  return finite(w) && w.x >= 0.0F && w.y >= 0.0F && w.z >= 0.0F;
}

void expect_sound(const Ray& ray) {
  ASSERT_TRUE(finite(ray.origin));
  ASSERT_TRUE(acceptable(ray.weight));
  ASSERT_GT(std::max({ray.weight.x, ray.weight.y, ray.weight.z}), 0.0F);
  ASSERT_NEAR(glm::length(ray.direction), 1.0F, 1e-6F);
  ASSERT_GT(ray.t_max, 0.0F);
}

TEST(HostileScenes, GiveOnlySoundRaysAndContributions) {
  std::array<int, 3> num_spawned{};
  for (std::uint64_t seed = 0; seed < 100'000; ++seed) {
    SCOPED_TRACE(seed);
    Hostile h(seed);
    SceneBuilder b;
    Texture texture;
    texture.width = texture.height = 2;
    texture.rgba.assign(16, 200);
    texture.nearest = h.coin();
    texture.wrap_u = static_cast<Texture::Wrap>(h.below(3));
    b.scene.textures = {texture};
    b.material(hostile_material(h));
    const auto normal = [&] { return h.coin() ? h.direction() : h.point(); };
    b.triangle({h.point(), h.point(), h.point()}, {normal(), normal(), normal()}, 0,
               {Vec2(h.point()), Vec2(h.point()), Vec2(h.point())});
    b.scene.lights = {hostile_light(h)};
    if (h.coin()) b.scene.lights[0].position = b.scene.positions[0];
    b.scene.background = h.amounts();
    const Shader shader(b.scene, {});

    Ray ray;
    ray.origin = h.point();
    ray.direction = h.direction();
    ray.weight = h.amounts();
    const float u = h.share();
    const Surface s = shader.surface(ray, {1.0F, u, h.coin() ? 0.0F : 1.0F - u, 0});
    ASSERT_TRUE(finite(s.position));
    ASSERT_NEAR(glm::length(s.geometric_normal), 1.0F, 1e-6F);
    ASSERT_NEAR(glm::length(s.shading_normal), 1.0F, 1e-6F);
    ASSERT_TRUE(acceptable(shader.emitted(ray, s)));
    ASSERT_TRUE(acceptable(shader.missed(ray)));
    Ray spawned;
    if (shader.reflect(ray, s, spawned)) {
      ++num_spawned[0];
      expect_sound(spawned);
    }
    if (shader.refract(ray, s, spawned)) {
      ++num_spawned[1];
      expect_sound(spawned);
    }
    if (shader.shadow(ray, s, 0, spawned)) {
      ++num_spawned[2];
      expect_sound(spawned);
    }
    if (HasFatalFailure()) return;
  }
  for (const int count : num_spawned) {
    EXPECT_GT(count, 1000);
  }
}

}  // namespace
}  // namespace sheaf::test
