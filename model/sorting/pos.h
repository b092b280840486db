// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sorting/heuristic.h"

namespace sheaf {

/// pos(x): every open cell has an anchor p_o, the origin of its first ray. A ray belongs to the
/// cell with the nearest anchor if ‖r_o − p_o‖² < x; of equally near ones to the lowest.
class PosHeuristic final : public Heuristic {
 public:
  PosHeuristic(float x, std::uint32_t num_cells)
      : x_(x), anchors_(num_cells), is_open_(num_cells, 0) {}

  [[nodiscard]] std::uint32_t find(const Vec3& origin, const Vec3& /*direction*/) const override {
    float nearest = x_;
    std::uint32_t found = kNoCell;
    for (std::uint32_t cell = 0; cell < anchors_.size(); ++cell) {
      if (is_open_[cell] == 0) continue;
      const Vec3 d = origin - anchors_[cell];
      const float distance2 = glm::dot(d, d);
      if (distance2 < nearest) {
        nearest = distance2;
        found = cell;
      }
    }
    return found;
  }
  void open(std::uint32_t cell, const Vec3& origin, const Vec3& /*direction*/) override {
    anchors_[cell] = origin;
    is_open_[cell] = 1;
  }
  void close(std::uint32_t cell) override { is_open_[cell] = 0; }

 private:
  float x_;
  std::vector<Vec3> anchors_;
  std::vector<std::uint8_t> is_open_;
};

}  // namespace sheaf
