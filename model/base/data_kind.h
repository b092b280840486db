// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sheaf {

/// What a simulated memory access is for. Memory counters are kept per kind.
enum class DataKind : std::uint8_t {
  kNode,       ///< kd-tree nodes
  kLeafList,   ///< primitive numbers of the leaves
  kTriangle,   ///< corners that the intersection unit tests
  kAttribute,  ///< shading data: vertex normals and UVs, materials
  kTexture,    ///< texels
  kPixel,      ///< frame buffer
  kSpilledRay  ///< spawned rays that had no place on chip
};
inline constexpr std::size_t kNumDataKinds = 7;

/// The kind's name in counters and reports.
[[nodiscard]] constexpr std::string_view to_string(DataKind kind) {
  constexpr std::array<std::string_view, kNumDataKinds> kNames{
      "node", "leaf_list", "triangle", "attribute", "texture", "pixel", "spilled_ray"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace sheaf
