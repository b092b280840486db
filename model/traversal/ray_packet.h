// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "base/access_cause.h"
#include "geometry/ray.h"

namespace sheaf {

inline constexpr int kMaxPacketSize = 64;
/// A set of active lanes; bit i is lane i.
using LaneMask = std::uint64_t;

template <typename T>
using Lanes = std::array<T, kMaxPacketSize>;

/// Up to 64 rays in structure-of-arrays form, and what they hit. Lanes >= size are never active,
/// and hold nothing: clearing them would cost time.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
struct alignas(64) RayPacket {
  std::array<Lanes<float>, 3> origin;
  std::array<Lanes<float>, 3> direction;
  Lanes<float> t_max;
  // Results. hit_triangle is kNoHit where nothing was hit; u and v are the barycentric weights of
  // the triangle's second and third vertex. Of a shadow ray only hit_triangle != kNoHit is
  // meaningful (any hit ends it).
  alignas(64) Lanes<float> hit_t;
  alignas(64) Lanes<float> hit_u;
  alignas(64) Lanes<float> hit_v;
  alignas(64) Lanes<std::uint32_t> hit_triangle;
  Lanes<Vec3> weight;
  Lanes<RayTag> tag;
  int size = 0;          ///< lanes of the machine's packet (1..64), active or not
  LaneMask active = 0;   ///< lanes that hold a ray
  LaneMask any_hit = 0;  ///< lanes that need only know whether something is hit (shadow rays)
  AccessCause cause;     ///< of where it is going, while a memory trace is recorded

  void put(int lane, const Ray& ray) {
    const auto i = static_cast<std::size_t>(lane);
    for (int axis = 0; axis < 3; ++axis) {
      origin[static_cast<std::size_t>(axis)][i] = ray.origin[axis];
      direction[static_cast<std::size_t>(axis)][i] = ray.direction[axis];
    }
    t_max[i] = ray.t_max;
    weight[i] = ray.weight;
    tag[i] = ray.tag;
    const LaneMask bit = LaneMask{1} << lane;
    active |= bit;
    any_hit = ray.tag.kind == RayKind::kShadow ? (any_hit | bit) : (any_hit & ~bit);
  }
  [[nodiscard]] Ray get(int lane) const {
    const auto i = static_cast<std::size_t>(lane);
    return {{origin[0][i], origin[1][i], origin[2][i]},
            t_max[i],
            {direction[0][i], direction[1][i], direction[2][i]},
            weight[i],
            tag[i]};
  }
  void clear(int packet_size) {
    size = packet_size;
    active = 0;
    any_hit = 0;
  }
};

}  // namespace sheaf
