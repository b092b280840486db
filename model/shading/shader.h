// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "geometry/ray.h"
#include "scene/scene.h"

namespace sheaf {

/// Where a ray met a triangle; u and v weigh the triangle's second and third vertex.
struct Hit {
  float t = 0.0F;
  float u = 0.0F;
  float v = 0.0F;
  std::uint32_t triangle = kNoHit;
};

/// One texel that shading read.
struct TexelAccess {
  std::uint32_t texture = 0;
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

/// A hit point with everything the spawned rays depend on.
struct Surface {
  Vec3 position{0.0F};
  Vec3 geometric_normal{0.0F};  ///< unit, on the side the ray came from
  Vec3 shading_normal{0.0F};    ///< unit, interpolated, on the side the ray came from
  bool entering = true;         ///< the ray met the front (counter-clockwise) side
  const Material* material = nullptr;
  Vec3 base_color{0.0F};        ///< textured
  Vec3 emission{0.0F};          ///< textured
  std::array<TexelAccess, 8> texels{};
  int num_texels = 0;
};

/// Pre-shading: pure functions of a ray, a hit and the scene. Nothing here knows of packets, time
/// or units, and no result depends on the order of calls.
class Shader {
 public:
  struct Options {
    std::uint32_t recursion_level = 1;
    float weight_cutoff = 0.0F;
  };
  Shader(const Scene& scene, const Options& options);

  [[nodiscard]] Surface surface(const Ray& ray, const Hit& hit) const;

  /// Contribution of the ray's own hit to its pixel: weight × (emission, or colour if unlit).
  [[nodiscard]] Vec3 emitted(const Ray& ray, const Surface& surface) const;
  /// Contribution of a ray that leaves the scene: weight × background.
  [[nodiscard]] Vec3 missed(const Ray& ray) const;

  // Each returns false if no such ray is spawned (no such part in the material, total internal
  // reflection, surface turned away from the light, weight zero or at the cutoff, depth reached).
  [[nodiscard]] bool reflect(const Ray& ray, const Surface& surface, Ray& spawned) const;
  [[nodiscard]] bool refract(const Ray& ray, const Surface& surface, Ray& spawned) const;
  [[nodiscard]] bool shadow(const Ray& ray, const Surface& surface, std::uint32_t light,
                            Ray& spawned) const;

 private:
  const Scene& scene_;
  Options options_;
};

}  // namespace sheaf
