// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "shading/shader.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "shading/saturate.h"
#include "shading/texture_lookup.h"

namespace sheaf {
namespace {

/// Whether a squared length is far enough from underflow and overflow that no component that
/// matters was lost in its square.
bool well_scaled(float squared) {
  return squared > 1e-34F && squared < 1e37F;
}

/// v as a unit vector; `otherwise` if v has no direction. Doubles hold the square of any float.
Vec3 unit_or(const Vec3d& v, const Vec3& otherwise) {
  const double length = std::sqrt(glm::dot(v, v));
  return length > 0.0 && std::isfinite(length) ? Vec3(v / length) : otherwise;
}

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const float squared = glm::dot(v, v);
  return well_scaled(squared) ? v * (1.0F / std::sqrt(squared)) : unit_or(Vec3d(v), otherwise);
}

/// Normal of a triangle with the edges e1 and e2; `otherwise` if it has no area.
Vec3 face_normal(const Vec3& e1, const Vec3& e2, const Vec3& otherwise) {
  const Vec3 n = glm::cross(e1, e2);
  const float squared = glm::dot(n, n);
  return well_scaled(squared) ? n * (1.0F / std::sqrt(squared))
                              : unit_or(glm::cross(Vec3d(e1), Vec3d(e2)), otherwise);
}

/// Multiplies `color` by the texture, if there is one, and records the texels read.
void apply_texture(const Scene& scene, std::int32_t index, const Vec2& uv, Vec3& color,
                   Surface& s) {
  if (index == kNoTexture) {
    return;
  }
  const TextureSample sample = sample_texture(scene.textures[static_cast<std::size_t>(index)], uv);
  color *= sample.color;
  for (int i = 0; i < sample.num_texels; ++i) {
    const TexelPosition& texel = sample.texels[i];
    s.texels[static_cast<std::size_t>(s.num_texels++)] = {static_cast<std::uint32_t>(index),
                                                          texel.x, texel.y};
  }
}

void check_texture(const Scene& scene, std::int32_t index, const std::string& material) {
  if (index == kNoTexture) {
    return;
  }
  if (index < 0 || static_cast<std::size_t>(index) >= scene.textures.size()) {
    throw std::logic_error("shader: material '" + material + "' names a texture out of range");
  }
  const Texture& texture = scene.textures[static_cast<std::size_t>(index)];
  const std::size_t texels = std::size_t{texture.width} * texture.height;
  if (texels == 0 || texture.rgba.size() < texels * 4) {
    throw std::logic_error("shader: a texture of material '" + material + "' lacks texels");
  }
  if (scene.uvs.size() != scene.positions.size()) {
    throw std::logic_error("shader: material '" + material + "' is textured, the scene has no UVs");
  }
}

}  // namespace

Shader::Shader(const Scene& scene, const Options& options)
    : scene_(scene),
      options_(options),
      offset_unit_(offset_unit(scene.bounds)),
      far_offset_(far_offset(scene.bounds)) {
  for (const Material& material : scene.materials) {
    check_texture(scene, material.base_color_texture, material.name);
    check_texture(scene, material.emission_texture, material.name);
    if (!(material.ior >= 1.0F && std::isfinite(material.ior))) {
      throw std::logic_error("shader: material '" + material.name + "' has an ior below 1");
    }
  }
}

Surface Shader::surface(const Ray& ray, const Hit& hit) const {
  const auto& [ia, ib, ic] = scene_.triangles[hit.triangle];
  const Vec3& a = scene_.positions[ia];
  const Vec3 e1 = scene_.positions[ib] - a;
  const Vec3 e2 = scene_.positions[ic] - a;

  Surface s;
  // From the vertices: the error is some ulps of the triangle's size, not of the distance
  // travelled.
  s.position = a + (hit.u * e1 + hit.v * e2);
  const Vec3 reach = glm::max(glm::abs(e1), glm::abs(e2));
  s.offset = {offset_unit_, least_offset(std::max({reach.x, reach.y, reach.z})), far_offset_};
  s.geometric_normal = face_normal(e1, e2, -ray.direction);
  s.entering = glm::dot(s.geometric_normal, ray.direction) <= 0.0F;
  s.geometric_normal = s.entering ? s.geometric_normal : -s.geometric_normal;

  const float w = 1.0F - hit.u - hit.v;
  s.shading_normal =
      unit_or(w * scene_.normals[ia] + hit.u * scene_.normals[ib] + hit.v * scene_.normals[ic],
              s.geometric_normal);
  if (glm::dot(s.shading_normal, s.geometric_normal) < 0.0F) {
    s.shading_normal = -s.shading_normal;
  }

  s.material = &scene_.materials[scene_.triangle_material[hit.triangle]];
  s.base_color = s.material->base_color;
  s.emission = s.material->emission;
  const bool textured =
      s.material->base_color_texture != kNoTexture || s.material->emission_texture != kNoTexture;
  if (textured) {
    const Vec2 uv = w * scene_.uvs[ia] + hit.u * scene_.uvs[ib] + hit.v * scene_.uvs[ic];
    apply_texture(scene_, s.material->base_color_texture, uv, s.base_color, s);
    apply_texture(scene_, s.material->emission_texture, uv, s.emission, s);
  }
  return s;
}

Vec3 Shader::emitted(const Ray& ray, const Surface& surface) const {
  return saturate(ray.weight * (surface.material->unlit ? surface.base_color : surface.emission));
}

Vec3 Shader::missed(const Ray& ray) const {
  return saturate(ray.weight * scene_.background);
}

}  // namespace sheaf
