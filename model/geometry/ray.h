// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/random.h"
#include "geometry/vec.h"

namespace sheaf {

inline constexpr std::uint32_t kNoHit = ~std::uint32_t{0};

enum class RayKind : std::uint8_t { kPrimary, kReflection, kRefraction, kShadow };
inline constexpr int kNumRayKinds = 4;

/// What one ray carries through the machine besides its geometry.
struct RayTag {
  std::uint64_t id = 0;     ///< function of pixel and path only
  std::uint32_t pixel = 0;  ///< row × width + column
  std::uint8_t depth = 0;   ///< primary 0
  RayKind kind = RayKind::kPrimary;
};

/// One ray outside a packet: as it is spawned, waits in the ray cache and is recorded.
struct Ray {
  Vec3 origin{0.0F};
  float t_max = 0.0F;    ///< shadow rays: distance to the light; else infinity
  Vec3 direction{0.0F};  ///< unit for reflection and refraction; shadow rays: unit
  Vec3 weight{0.0F};     ///< RGB that multiplies what the ray finds
  RayTag tag;
};

/// Identity of a camera ray and of the ray that its parent spawned into `slot` (0 reflection,
/// 1 refraction, 2 + i the shadow ray to light i).
[[nodiscard]] constexpr std::uint64_t primary_ray_id(std::uint32_t pixel) {
  return mix64(std::uint64_t{pixel} + 1);
}
[[nodiscard]] constexpr std::uint64_t child_ray_id(std::uint64_t parent, std::uint32_t slot) {
  return mix64(parent + (std::uint64_t{slot} + 1) * 0x9e3779b97f4a7c15ULL);
}

}  // namespace sheaf
