// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "traversal/ray_packet.h"

namespace sheaf {

/// A ray told from others by its id.
inline Ray ray_of(std::uint64_t id, const Vec3& direction, const Vec3& origin = Vec3(0.0F),
                  RayKind kind = RayKind::kReflection) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.tag.id = id;
  ray.tag.kind = kind;
  return ray;
}

/// Ids of a packet's rays in lane order.
inline std::vector<std::uint64_t> ids_of(const RayPacket& packet) {
  std::vector<std::uint64_t> ids;
  for (int lane = 0; lane < kMaxPacketSize; ++lane) {
    if ((packet.active >> lane & 1U) != 0) ids.push_back(packet.get(lane).tag.id);
  }
  return ids;
}

inline std::vector<std::vector<std::uint64_t>> ids_of(const std::vector<RayPacket*>& packets) {
  std::vector<std::vector<std::uint64_t>> ids;
  for (const RayPacket* packet : packets) ids.push_back(ids_of(*packet));
  return ids;
}

}  // namespace sheaf
