// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "shading/shader.h"
#include "sorting/spawn_bundle.h"
#include "traversal/ray_packet.h"

namespace sheaf {

/// Something to be added to a pixel.
struct PixelContribution {
  std::uint32_t pixel = 0;
  Vec3 radiance{0.0F};
};

/// Everything that shading one traced packet gives and reads. Reused between packets.
struct PacketShading {
  std::vector<PixelContribution> contributions;  ///< in lane order; nothing that is zero
  LaneMask contributed = 0;                      ///< the lanes that these came from
  std::vector<std::uint32_t> triangles;          ///< triangles whose attributes were read
  std::vector<TexelAccess> texels;
  SpawnBundle spawned;
  int num_post_shaded = 0;  ///< shadow rays, whatever they met

  void clear();
};

/// Where the machine's shader units get what comes of a traced packet: computed, or out of a trace.
/// The result must not depend on the order of calls.
class ShadingSource {
 public:
  virtual ~ShadingSource() = default;
  virtual void shade(const RayPacket& packet, PacketShading& out) = 0;
};

}  // namespace sheaf
