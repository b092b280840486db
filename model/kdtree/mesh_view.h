// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geometry/vec.h"

namespace sheaf {

/// The triangles that a tree is built over, as the scene holds them.
struct MeshView {
  std::span<const Vec3> positions;
  std::span<const std::array<std::uint32_t, 3>> triangles;  ///< indices into positions

  [[nodiscard]] std::array<Vec3, 3> corners(std::uint32_t triangle) const {
    const auto& index = triangles[triangle];
    return {positions[index[0]], positions[index[1]], positions[index[2]]};
  }
};

}  // namespace sheaf
