// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geometry/vec.h"
#include "scene/scene.h"

namespace sheaf {

/// Column and row of one texel.
struct TexelPosition {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

/// A filtered colour and the texels that it was made of.
struct TextureSample {
  Vec3 color{0.0F};  ///< linear RGB, each in [0, 1]
  TexelPosition texels[4]{};
  int num_texels = 0;  ///< 1 for nearest, 4 for bilinear, in the order (x0, y0), (x1, y0), …
};

/// Linear value of an sRGB-encoded byte (IEC 61966-2-1).
[[nodiscard]] float srgb_to_linear(std::uint8_t encoded);

/// Looks up a colour texture at uv as glTF 2.0 asks (section 3.8.4: (0, 0) is the upper left corner
/// of the upper left texel). Texels are made linear before they are filtered. A coordinate that is
/// not finite counts as 0.
[[nodiscard]] TextureSample sample_texture(const Texture& texture, const Vec2& uv);

}  // namespace sheaf
