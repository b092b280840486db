// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "shading/texture_lookup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sheaf {
namespace {

std::array<float, 256> make_linear_values() {
  std::array<float, 256> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double encoded = static_cast<double>(i) / 255.0;
    values[i] = static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                      : std::pow((encoded + 0.055) / 1.055, 2.4));
  }
  return values;
}

const std::array<float, 256> kLinearValues = make_linear_values();

/// Brings a coordinate into one period of its wrap mode, where its texel number is a small integer.
float reduce(float u, Texture::Wrap wrap) {
  if (!std::isfinite(u)) {
    return 0.0F;
  }
  switch (wrap) {
    case Texture::Wrap::kRepeat:
      return u - std::floor(u);
    case Texture::Wrap::kMirroredRepeat:
      return u - 2.0F * std::floor(0.5F * u);
    case Texture::Wrap::kClampToEdge:
      break;
  }
  return std::clamp(u, 0.0F, 1.0F);
}

/// Texel number of i, which lies within one texture size outside the reduced range.
std::uint32_t wrap_texel(std::int64_t i, std::int64_t size, Texture::Wrap wrap) {
  switch (wrap) {
    case Texture::Wrap::kRepeat:
      i = i < 0 ? i + size : i;
      i = i >= size ? i - size : i;
      break;
    case Texture::Wrap::kMirroredRepeat:
      // At both ends of the period the mirror image begins with the texel that the clamp gives.
      i = i >= size ? 2 * size - 1 - i : i;
      break;
    case Texture::Wrap::kClampToEdge:
      break;
  }
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(i, 0, size - 1));
}

Vec3 texel_color(const Texture& texture, const TexelPosition& texel) {
  const std::uint8_t* rgba = &texture.rgba[(std::size_t{texel.y} * texture.width + texel.x) * 4];
  return {kLinearValues[rgba[0]], kLinearValues[rgba[1]], kLinearValues[rgba[2]]};
}

/// Two neighbouring texels along one axis and the share of the second.
struct Span {
  std::uint32_t first, second;
  float share;
};

Span bilinear_span(float u, std::uint32_t size, Texture::Wrap wrap) {
  const float x = reduce(u, wrap) * static_cast<float>(size) - 0.5F;
  const float left = std::floor(x);
  const auto i = static_cast<std::int64_t>(left);
  return {wrap_texel(i, size, wrap), wrap_texel(i + 1, size, wrap), x - left};
}

std::uint32_t nearest_texel(float u, std::uint32_t size, Texture::Wrap wrap) {
  const float x = std::floor(reduce(u, wrap) * static_cast<float>(size));
  return wrap_texel(static_cast<std::int64_t>(x), size, wrap);
}

}  // namespace

float srgb_to_linear(std::uint8_t encoded) {
  return kLinearValues[encoded];
}

TextureSample sample_texture(const Texture& texture, const Vec2& uv) {
  TextureSample sample;
  if (texture.nearest) {
    sample.texels[0] = {nearest_texel(uv.x, texture.width, texture.wrap_u),
                        nearest_texel(uv.y, texture.height, texture.wrap_v)};
    sample.num_texels = 1;
    sample.color = texel_color(texture, sample.texels[0]);
    return sample;
  }
  const Span x = bilinear_span(uv.x, texture.width, texture.wrap_u);
  const Span y = bilinear_span(uv.y, texture.height, texture.wrap_v);
  sample.texels[0] = {x.first, y.first};
  sample.texels[1] = {x.second, y.first};
  sample.texels[2] = {x.first, y.second};
  sample.texels[3] = {x.second, y.second};
  sample.num_texels = 4;
  const Vec3 upper = (1.0F - x.share) * texel_color(texture, sample.texels[0]) +
                     x.share * texel_color(texture, sample.texels[1]);
  const Vec3 lower = (1.0F - x.share) * texel_color(texture, sample.texels[2]) +
                     x.share * texel_color(texture, sample.texels[3]);
  sample.color = (1.0F - y.share) * upper + y.share * lower;
  return sample;
}

}  // namespace sheaf
