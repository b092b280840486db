// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace sheaf {

/// False colour of a share in [0, 1], as sRGB bytes: from near black over violet, teal and green to
/// light yellow. The five control points were chosen for steps of CIE lightness L* of about 22
/// each, so that equal differences of the counter look about equally large, in grey too.
[[nodiscard]] inline std::array<std::uint8_t, 3> heat_color(float share) {
  constexpr std::array<std::array<float, 3>, 5> kControlPoints{{{12.0F, 8.0F, 38.0F},
                                                                {62.0F, 44.0F, 128.0F},
                                                                {24.0F, 118.0F, 140.0F},
                                                                {82.0F, 182.0F, 92.0F},
                                                                {252.0F, 236.0F, 110.0F}}};
  constexpr auto kSegments = static_cast<float>(kControlPoints.size() - 1);
  const float x = std::clamp(share, 0.0F, 1.0F) * kSegments;
  const std::size_t left = std::min(static_cast<std::size_t>(x), kControlPoints.size() - 2);
  const float within = x - static_cast<float>(left);
  std::array<std::uint8_t, 3> color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    const float from = kControlPoints[left][i];
    const float to = kControlPoints[left + 1][i];
    color[i] = static_cast<std::uint8_t>(from + within * (to - from) + 0.5F);
  }
  return color;
}

}  // namespace sheaf
