// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geometry/box.h"

namespace sheaf {

/// n × n × n equal voxels of a box; points outside belong to the nearest, like what is no number.
class VoxelGrid {
 public:
  VoxelGrid(const Box& bounds, std::uint32_t n) : n_(n), lo_(bounds.lo) {
    const Vec3 extent = bounds.extent();
    for (int axis = 0; axis < 3; ++axis) {
      scale_[axis] = extent[axis] > 0.0F ? static_cast<float>(n) / extent[axis] : 0.0F;
    }
  }

  [[nodiscard]] std::uint32_t num_voxels() const { return n_ * n_ * n_; }
  [[nodiscard]] std::uint32_t voxel(const Vec3& point) const {
    return (cell(point, 2) * n_ + cell(point, 1)) * n_ + cell(point, 0);
  }

 private:
  [[nodiscard]] std::uint32_t cell(const Vec3& point, int axis) const {
    const float position = (point[axis] - lo_[axis]) * scale_[axis];
    if (!(position > 0.0F)) return 0;
    return position < static_cast<float>(n_) ? static_cast<std::uint32_t>(position) : n_ - 1;
  }

  std::uint32_t n_;
  Vec3 lo_;
  Vec3 scale_{0.0F};
};

}  // namespace sheaf
