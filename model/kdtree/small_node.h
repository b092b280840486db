// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/box.h"
#include "kdtree/split_search.h"

namespace sheaf {

/// A node of few triangles, kept as the boxes of their parts inside the cell. Unused places hold
/// empty boxes, so that vectors may read beyond the count.
struct SmallNode {
  static constexpr std::size_t kCapacity = 32;
  using Row = std::array<float, kCapacity>;

  alignas(64) std::array<Row, 3> lo;  ///< axis, triangle
  alignas(64) std::array<Row, 3> hi;
  std::array<std::uint32_t, kCapacity> triangle;  ///< ascending
  std::size_t count = 0;

  // Triangles are read up to the count only.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
  SmallNode() {
    for (Row& row : lo) row.fill(std::numeric_limits<float>::infinity());
    for (Row& row : hi) row.fill(-std::numeric_limits<float>::infinity());
  }
};

/// As the other find_split, with the same candidates and costs, by counting instead of sweeping:
/// O(N^2), but in vectors and without sorted lists. Costs are computed in single precision.
[[nodiscard]] SplitPlane find_split(const SmallNode& node, const Box& cell, const SahCosts& costs);

}  // namespace sheaf
