// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "geometry/ray.h"
#include "scene/scene.h"
#include "shading/ray_offset.h"

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
  std::uint32_t texture;
  std::uint32_t x;
  std::uint32_t y;
};

/// A hit point with everything the spawned rays depend on.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
struct Surface {
  Vec3 position{0.0F};
  Vec3 geometric_normal{0.0F};  ///< unit, on the side the ray came from
  Vec3 shading_normal{0.0F};    ///< unit, interpolated, in the hemisphere of geometric_normal
  bool entering = true;         ///< the ray met the front (counter-clockwise) side
  OffsetScale offset;           ///< of rays that start here
  const Material* material = nullptr;
  Vec3 base_color{0.0F};              ///< textured
  Vec3 emission{0.0F};                ///< textured
  std::array<TexelAccess, 8> texels;  ///< the first num_texels; clearing the rest would cost time
  int num_texels = 0;
};

/// Pre-shading: pure functions of a ray, a hit and the scene. Nothing here knows of packets, time
/// or units, and no result depends on the order of calls. All in single precision.
///
/// A ray of weight W that hits a surface of base colour c spawns
///   reflection  W · (mirror_weight · (c if tinted, else 1) + transmission · F)
///   refraction  W · transmission · (1 - F) · c
///   shadow ray  W · diffuse_weight · c/π · cosθ · E, for each light that both normals face
/// where F is the exact unpolarised Fresnel reflectance at the interpolated normal (dielectric.h),
/// θ the angle between that normal and the light, and E the light's irradiance at normal incidence
/// (lighting.h). The relative index is 1/ior for rays that meet the front side and ior from behind.
///
/// Reflected and refracted directions follow the interpolated normal. Where that would lead through
/// the surface (reflection) or not through it (refraction), the reflection follows the geometric
/// normal and the refraction goes straight on.
///
/// Reflection and refraction rays have depth + 1 <= recursion_level; shadow rays exist at every
/// level. A ray whose largest weight component is at or below weight_cutoff is not spawned. Weights
/// are finite: FLT_MAX stands for what is larger, 0 for what is no number.
///
/// Origins are moved off the surface (ray_offset.h) to the side that the ray leaves to; t_max of a
/// shadow ray is the distance from there to the light, infinity for directional lights.
class Shader {
 public:
  struct Options {
    std::uint32_t recursion_level = 1;
    float weight_cutoff = 0.0F;
  };
  /// The scene must outlive the shader. Throws std::logic_error if a material breaks the contract
  /// of scene.h: a texture that is not there or lacks texels or UVs, an ior below 1.
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
  float offset_unit_;
  float far_offset_;
};

}  // namespace sheaf
