// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "shading/reference_surface.h"

#include <cmath>
#include <cstddef>

namespace sheaf {
namespace {

/// The texel that texel number i stands for, for any i.
std::uint32_t wrapped(double i, std::uint32_t size, Texture::Wrap wrap) {
  const auto n = static_cast<double>(size);
  switch (wrap) {
    case Texture::Wrap::kRepeat:
      i -= n * std::floor(i / n);
      break;
    case Texture::Wrap::kMirroredRepeat:
      i -= 2.0 * n * std::floor(i / (2.0 * n));
      i = i < n ? i : 2.0 * n - 1.0 - i;
      break;
    case Texture::Wrap::kClampToEdge:
      break;
  }
  return static_cast<std::uint32_t>(std::fmin(std::fmax(i, 0.0), n - 1.0));
}

double linear(std::uint8_t byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Vec3d texel(const Texture& t, double x, double y) {
  const std::size_t column = wrapped(x, t.width, t.wrap_u);
  const std::size_t row = wrapped(y, t.height, t.wrap_v);
  const std::size_t at = (row * t.width + column) * 4;
  return {linear(t.rgba[at]), linear(t.rgba[at + 1]), linear(t.rgba[at + 2])};
}

Vec3d texture_color(const Texture& t, double u, double v) {
  const double x = (std::isfinite(u) ? u : 0.0) * t.width;
  const double y = (std::isfinite(v) ? v : 0.0) * t.height;
  if (t.nearest) {
    return texel(t, std::floor(x), std::floor(y));
  }
  const double x0 = std::floor(x - 0.5);
  const double y0 = std::floor(y - 0.5);
  const double fx = x - 0.5 - x0;
  const double fy = y - 0.5 - y0;
  return (1.0 - fy) * ((1.0 - fx) * texel(t, x0, y0) + fx * texel(t, x0 + 1.0, y0)) +
         fy * ((1.0 - fx) * texel(t, x0, y0 + 1.0) + fx * texel(t, x0 + 1.0, y0 + 1.0));
}

}  // namespace

ReferenceSurface reference_surface(const Scene& scene, const ReferenceRay& ray,
                                   const ReferenceHit& hit) {
  const auto& corners = scene.triangles[hit.triangle];
  const std::uint32_t ia = corners[0];
  const std::uint32_t ib = corners[1];
  const std::uint32_t ic = corners[2];
  const double w = 1.0 - hit.u - hit.v;
  const Vec3d a(scene.positions[ia]);
  const Vec3d b(scene.positions[ib]);
  const Vec3d c(scene.positions[ic]);

  ReferenceSurface s;
  s.position = w * a + hit.u * b + hit.v * c;
  // A triangle without area is never hit here, so the normal exists.
  s.geometric_normal = glm::normalize(glm::cross(b - a, c - a));
  s.entering = glm::dot(s.geometric_normal, ray.direction) <= 0.0;
  if (!s.entering) {
    s.geometric_normal = -s.geometric_normal;
  }
  const Vec3d sum = w * Vec3d(scene.normals[ia]) + hit.u * Vec3d(scene.normals[ib]) +
                    hit.v * Vec3d(scene.normals[ic]);
  const double length = glm::length(sum);
  s.shading_normal = length > 0.0 && std::isfinite(length) ? sum / length : s.geometric_normal;
  if (glm::dot(s.shading_normal, s.geometric_normal) < 0.0) {
    s.shading_normal = -s.shading_normal;
  }

  s.material = &scene.materials[scene.triangle_material[hit.triangle]];
  s.base_color = Vec3d(s.material->base_color);
  s.emission = Vec3d(s.material->emission);
  const auto tint = [&](std::int32_t texture, Vec3d& color) {
    if (texture != kNoTexture) {
      const glm::dvec2 uv = w * glm::dvec2(scene.uvs[ia]) + hit.u * glm::dvec2(scene.uvs[ib]) +
                            hit.v * glm::dvec2(scene.uvs[ic]);
      color *= texture_color(scene.textures[static_cast<std::size_t>(texture)], uv.x, uv.y);
    }
  };
  tint(s.material->base_color_texture, s.base_color);
  tint(s.material->emission_texture, s.emission);
  return s;
}

}  // namespace sheaf
