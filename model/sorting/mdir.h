// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "sorting/keyed.h"

namespace sheaf {

/// mdir(x): the cell of a direction cube with 6 faces of k × k cells, x = 6 k², equal in face
/// coordinates. The face is that of the longest axis (the first of equals) and its sign. With even
/// k no cell mixes direction signs: the face coordinate 0 is a cell boundary, and the sign of a
/// zero coordinate is its sign bit.
class MdirHeuristic final : public KeyedHeuristic {
 public:
  MdirHeuristic(std::uint32_t k, std::uint32_t num_cells)
      : KeyedHeuristic(6 * k * k, num_cells), k_(k) {}

  [[nodiscard]] std::uint32_t key(const Vec3& /*origin*/, const Vec3& direction) const override {
    const Vec3 length = glm::abs(direction);
    int axis = 0;
    if (length.y > length[axis]) axis = 1;
    if (length.z > length[axis]) axis = 2;
    const std::uint32_t face =
        static_cast<std::uint32_t>(axis) * 2 + (std::signbit(direction[axis]) ? 1U : 0U);
    const std::uint32_t u = cell(direction[(axis + 1) % 3], length[axis]);
    const std::uint32_t v = cell(direction[(axis + 2) % 3], length[axis]);
    return (face * k_ + v) * k_ + u;
  }

 private:
  /// Cell of a face coordinate a / longest in [-1, 1]. The magnitude is scaled apart from the
  /// sign, so that ±0 and the halves of an even k fall on their own side.
  [[nodiscard]] std::uint32_t cell(float a, float longest) const {
    const float ratio = longest > 0.0F ? std::fabs(a) / longest : 0.0F;
    const auto k = static_cast<float>(k_);
    const bool negative = std::signbit(a);
    if (k_ % 2 == 0) {
      const std::uint32_t half = k_ / 2;
      auto step = static_cast<std::uint32_t>(ratio * static_cast<float>(half));
      if (step >= half) step = half - 1;
      return negative ? half - 1 - step : half + step;
    }
    const float position = (negative ? -ratio : ratio) * 0.5F + 0.5F;
    const auto index = static_cast<std::uint32_t>(position * k);
    return index < k_ ? index : k_ - 1;
  }

  std::uint32_t k_;
};

}  // namespace sheaf
