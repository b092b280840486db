// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sorting/mdir.h"
#include "sorting/voxel_grid.h"

namespace sheaf {

/// ray5d(x): the classification of Arvo and Kirk, "Fast ray tracing by ray classification", 1987:
/// a ray is a point in the five dimensions of its origin and its place on a direction cube. Each of
/// x levels halves all five, as their tree does where rays are many; here every branch is of depth
/// x, since hardware has the keys of a fixed tree for nothing. 6 · 32^x keys.
class Ray5dHeuristic final : public KeyedHeuristic {
 public:
  static constexpr std::uint32_t kMaxLevels = 3;
  [[nodiscard]] static std::uint32_t num_keys(std::uint32_t levels) { return 6U << (5 * levels); }

  Ray5dHeuristic(std::uint32_t levels, const Box& bounds, std::uint32_t num_cells)
      : KeyedHeuristic(num_keys(levels), num_cells),
        origins_(bounds, 1U << levels),
        directions_(1U << levels, 1) {}

  [[nodiscard]] std::uint32_t key(const Vec3& origin, const Vec3& direction) const override {
    return directions_.key(origin, direction) * origins_.num_voxels() + origins_.voxel(origin);
  }

 private:
  VoxelGrid origins_;
  MdirHeuristic directions_;
};

}  // namespace sheaf
