// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Pictures lit by extreme lights.
#include <fmt/format.h>

#include <cmath>

#include "stability/catalogue.h"
#include "stability/shaded_mesh.h"

namespace sheaf::stability {
namespace {

/// A body of that size on a field, the light five times as high above it.
Scene lit_scene(float intensity, float size = 1.0F) {
  Material material;
  material.base_color = Vec3(0.8F, 0.5F, 0.3F);
  Scene scene = scene_of(teapot_in_stadium(size, 4.0F * size), material);
  Light light;
  light.position = size * Vec3(1.0F, 5.0F, 2.0F);
  light.intensity = Vec3(intensity);
  scene.lights = {light};
  return scene;
}

bool same(const Vec3& a, const Vec3& b, float factor) {
  return a.x * factor == b.x && a.y * factor == b.y && a.z * factor == b.z;
}

std::vector<Finding> powers_of_two(const Effort& effort) {
  const Picture plain = render(lit_scene(1.0F));
  Failures unlike;
  for (int exponent = -100; exponent <= 100; exponent += effort.quick ? 50 : 10) {
    const float factor = std::ldexp(1.0F, exponent);
    const Picture picture = render(lit_scene(factor));
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
      unlike.check(same(plain.pixels[i], picture.pixels[i], factor),
                   [&] { return fmt::format("2^{}, pixel {}", exponent, i); });
    }
  }
  return {unlike.finding("pixels that do not scale with the light",
                         "products with a power of two are exact, short of under- and overflow")};
}

std::vector<Finding> powers_of_ten() {
  const Picture plain = render(lit_scene(1.0F));
  Largest error;
  for (const float factor : {1e-30F, 1e-20F, 1e-10F, 1e10F, 1e20F, 1e30F}) {
    const Picture picture = render(lit_scene(factor));
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        const double right = double{plain.pixels[i][channel]} * double{factor};
        if (right == 0.0) continue;
        error.add(std::abs(double{picture.pixels[i][channel]} - right) / right,
                  [&] { return fmt::format("intensity {}, pixel {}", factor, i); });
      }
    }
  }
  return {error.finding("relative error of a pixel against the picture lit by 1 candela",
                        {2.0 * gamma(3),
                         "2 gamma(3): in each picture, two products behind the intensity and the "
                         "rounding of the exact sum"})};
}

/// Counts the pixels that are no finite number ≥ 0, in every format of the film.
void check_pixels(const Scene& scene, const std::string& what, Failures& bad) {
  for (const char* format : {"unorm8", "half", "float", "exact"}) {
    const Picture picture =
        render(scene, {fmt::format("film.format={}", format), "render.recursion_level=3"});
    for (const Vec3& p : picture.pixels) {
      bad.check(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && p.x >= 0.0F &&
                    p.y >= 0.0F && p.z >= 0.0F,
                [&] { return fmt::format("{}, {}", format, what); });
    }
  }
}

/// Everything as large, small and near as it may be: weights and sums overflow, squares underflow.
std::vector<Finding> nothing_but_numbers() {
  Failures bad;
  for (const float intensity : {1e-45F, 1e-30F, 1e30F, 3e38F}) {
    const auto extreme = [&](float size) {
      Scene scene = lit_scene(intensity, size);
      scene.materials[0].emission = Vec3(0.0F, 1e-45F, 3e38F);
      scene.materials[0].mirror_weight = 0.5F;
      scene.materials[0].diffuse_weight = 0.5F;
      scene.background = Vec3(1e30F);
      return scene;
    };
    for (const float height : {1e-20F, 1e-6F, 1e6F, 1e15F}) {
      Scene scene = extreme(1.0F);
      scene.lights[0].position = Vec3(0.0F, height, 0.5F);
      check_pixels(scene, fmt::format("{} candela at {}", intensity, height), bad);
    }
    // Within millimetres the largest intensities are more than a float at every surface.
    check_pixels(extreme(1e-3F), fmt::format("{} candela within millimetres", intensity), bad);
  }
  return {bad.finding("pixels that are no finite number >= 0",
                      "weights saturate at the largest float (saturate.h), and so do films")};
}

}  // namespace

std::vector<StabilityCase> light_cases() {
  return {{"light", "powers of two", "intensities from 2^-100 to 2^100", powers_of_two},
          {"light", "powers of ten", "intensities from 1e-30 to 1e30",
           [](const Effort&) { return powers_of_ten(); }},
          {"light", "overflow",
           "3e38 candela at a distance of 1e-20 or a millimetre, emission of 3e38, in all formats",
           [](const Effort&) { return nothing_but_numbers(); }}};
}

}  // namespace sheaf::stability
