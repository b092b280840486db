// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/box.h"
#include "geometry/vec.h"

namespace sheaf {

/// 8-bit RGBA image with its glTF sampler. Texel (0, 0) is the image's upper left corner.
struct Texture {
  enum class Wrap : std::uint8_t { kRepeat, kMirroredRepeat, kClampToEdge };
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Wrap wrap_u = Wrap::kRepeat;
  Wrap wrap_v = Wrap::kRepeat;
  bool nearest = false;            ///< nearest texel instead of bilinear
  std::vector<std::uint8_t> rgba;  ///< width × height × 4, row by row; colour is sRGB-encoded
};

inline constexpr std::int32_t kNoTexture = -1;

/// A surface as the shader sees it. Light arriving along a ray is split between the parts:
///   emission                       always added
///   diffuse_weight · base_color    Lambertian, lit by the scene's lights (shadow rays)
///   mirror_weight                  perfect mirror (reflection ray); tinted by base_color if tinted
///   transmission                   dielectric of index ior: Fresnel-weighted reflection and
///                                  refraction rays, the refracted one tinted by base_color
struct Material {
  std::string name;
  Vec3 base_color{1.0F};  ///< linear RGB in [0, 1], multiplied by the texture
  std::int32_t base_color_texture = kNoTexture;
  Vec3 emission{0.0F};  ///< linear RGB radiance, emissive_strength included
  std::int32_t emission_texture = kNoTexture;
  float diffuse_weight = 1.0F;  ///< in [0, 1]
  float mirror_weight = 0.0F;   ///< in [0, 1]
  bool mirror_tinted = true;    ///< metals colour their reflection; scene.reflectance does not
  float transmission = 0.0F;    ///< in [0, 1]
  float ior = 1.5F;             ///< >= 1
  bool unlit = false;           ///< KHR_materials_unlit: base colour is emitted, nothing spawned

  /// Which secondary rays a hit of this material can spawn.
  [[nodiscard]] bool reflects() const {
    return !unlit && (mirror_weight > 0.0F || (transmission > 0.0F && ior != 1.0F));
  }
  [[nodiscard]] bool refracts() const { return !unlit && transmission > 0.0F; }
  [[nodiscard]] bool diffuse() const { return !unlit && diffuse_weight > 0.0F; }
};

/// KHR_lights_punctual. Point and spot lights: intensity in candela; directional: in lux.
struct Light {
  enum class Type : std::uint8_t { kPoint, kSpot, kDirectional };
  Type type = Type::kPoint;
  Vec3 position{0.0F};                ///< world space; unused for directional lights
  Vec3 direction{0.0F, 0.0F, -1.0F};  ///< unit, the way the light shines; unused for point lights
  Vec3 intensity{1.0F};               ///< colour × intensity
  float range = 0.0F;                 ///< metres; 0 = infinite
  float cos_inner_cone = 1.0F;        ///< spot only
  float cos_outer_cone = 0.7071068F;  ///< spot only
};

/// Pinhole or orthographic camera in world space; right, up and forward are orthonormal.
struct Camera {
  Vec3 position{0.0F};
  Vec3 right{1.0F, 0.0F, 0.0F};
  Vec3 up{0.0F, 1.0F, 0.0F};
  Vec3 forward{0.0F, 0.0F, -1.0F};
  bool orthographic = false;
  float half_height = 0.4142136F;  ///< perspective: tan(yfov/2); orthographic: ymag
};

/// What the scene needs of the machine; everything else is left out.
struct SceneNeeds {
  bool lights = false;      ///< shadow rays and post-shading
  bool reflection = false;  ///< some material can spawn a reflection ray
  bool refraction = false;  ///< some material can spawn a refraction ray
  bool textures = false;    ///< UVs and the texture cache
  bool operator==(const SceneNeeds&) const = default;
};

/// A scene flattened to world space: the geometry that the kd-tree is built over and everything
/// the shader reads. Index of a triangle in `triangles` is its primitive number.
struct Scene {
  std::vector<Vec3> positions;                          ///< per vertex
  std::vector<Vec3> normals;                            ///< per vertex, unit
  std::vector<Vec2> uvs;                                ///< per vertex; empty if no texture is used
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< vertex indices, counter-clockwise
  std::vector<std::uint16_t> triangle_material;         ///< per triangle, index into materials
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Light> lights;
  Camera camera;
  Vec3 background{0.0F};  ///< radiance of a ray that leaves the scene
  Box bounds;             ///< of all positions used
  SceneNeeds needs;
};

}  // namespace sheaf
