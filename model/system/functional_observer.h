// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/shading_source.h"
#include "traversal/trace.h"

namespace sheaf {

/// Is told of what a run without time does, in order.
class FunctionalObserver {
 public:
  virtual ~FunctionalObserver() = default;
  /// The first packet of this tile is admitted.
  virtual void tile_begins(std::uint32_t tile) = 0;
  /// A packet has been traced; `log`: what it touched.
  virtual void traced(const RayPacket& packet, const TraceLog& log) = 0;
  virtual void shaded(const RayPacket& packet, const PacketShading& shading) = 0;
};

}  // namespace sheaf
