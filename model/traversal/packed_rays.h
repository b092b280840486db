// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geometry/watertight.h"
#include "traversal/ray_packet.h"

namespace sheaf {

/// The rays of a packet, packed into the first `count` lanes, with what the kernels need of them
/// computed once. Lanes behind them, up to a whole vector, are inert.
struct alignas(64) PackedRays {
  /// What a step across a split plane of one axis reads.
  struct Axis {
    alignas(64) Lanes<float> near_origin;  ///< origin moved back against the direction by the error
    Lanes<float> far_origin;               ///< origin moved on along the direction by the error
    Lanes<float> inverse;                  ///< 1 / direction; ±infinity for ±0
  };
  std::array<Axis, 3> axis;
  Lanes<float> enter;  ///< where the ray enters the tree's bounds, rounded towards the origin
  Lanes<float> leave;  ///< where it leaves them, or t_max; enter > leave where it misses them

  // The watertight test: see ShearedRay.
  std::array<Lanes<float>, 3> origin;  ///< along the ray's x, y and z
  std::array<Lanes<float>, 3> shear;
  std::array<Lanes<std::uint32_t>, 3> permutation;  ///< axis that is the ray's x, y and z
  std::array<LaneMask, 3> longest;                  ///< by axis: the lanes whose z it is

  // Results. A hit must have t below `limit`, or equal to it and a lower primitive number.
  alignas(64) Lanes<float> limit;  ///< -infinity once a lane needs no more hits
  Lanes<float> hit_t;
  Lanes<float> hit_u;
  Lanes<float> hit_v;
  Lanes<std::uint32_t> hit_triangle;
  LaneMask any_hit;  ///< lanes whose first hit ends them
  LaneMask has_hit;

  int count;
  Lanes<std::uint8_t> packet_lane;  ///< where each ray stands in its packet

  [[nodiscard]] ShearedRay sheared_ray(std::size_t lane) const {
    ShearedRay ray;  // NOLINT(cppcoreguidelines-pro-type-member-init): assigned one by one
    ray.x = permutation[0][lane];
    ray.y = permutation[1][lane];
    ray.z = permutation[2][lane];
    ray.origin_x = origin[0][lane];
    ray.origin_y = origin[1][lane];
    ray.origin_z = origin[2][lane];
    ray.shear_x = shear[0][lane];
    ray.shear_y = shear[1][lane];
    ray.shear_z = shear[2][lane];
    return ray;
  }
};

}  // namespace sheaf
