// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geometry/ray.h"
#include "traversal/packet_pool.h"

namespace sheaf {

/// All rays that one packet spawned, in the order in which they arrive at the ray cache:
/// reflections, then refractions, then the shadow rays of each light, each in lane order.
struct SpawnBundle {
  std::vector<Ray> rays;
  std::vector<std::uint8_t> lanes;  ///< of the parent, one per ray
  std::vector<std::size_t> group_begins;
  AccessCause cause;  ///< while a memory trace is recorded

  void clear() {
    rays.clear();
    lanes.clear();
    group_begins.clear();
  }
  void begin_group() { group_begins.push_back(rays.size()); }
  void add(const Ray& ray, int lane) {
    rays.push_back(ray);
    lanes.push_back(static_cast<std::uint8_t>(lane));
  }
};

/// The heuristic `none`: each non-empty group travels on as one packet, every ray in its parent's
/// lane, partly filled.
inline void split_by_kind(const SpawnBundle& bundle, PacketPool& pool,
                          std::vector<RayPacket*>& packets) {
  for (std::size_t g = 0; g < bundle.group_begins.size(); ++g) {
    const std::size_t end =
        g + 1 < bundle.group_begins.size() ? bundle.group_begins[g + 1] : bundle.rays.size();
    if (bundle.group_begins[g] == end) continue;
    RayPacket* packet = pool.acquire();
    for (std::size_t i = bundle.group_begins[g]; i < end; ++i) {
      packet->put(bundle.lanes[i], bundle.rays[i]);
    }
    packets.push_back(packet);
  }
}

}  // namespace sheaf
