// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "system/machine.h"

namespace sheaf {

/// All channels of a machine, by what they join.
struct Machine::Links {
  template <typename T>
  using Channels = std::vector<std::unique_ptr<TimedChannel<T>>>;

  std::unique_ptr<PacketChannel> source_to_arbiter;
  std::unique_ptr<PacketChannel> packet_fifo;
  std::unique_ptr<TimedChannel<ContextFree>> traversal_to_arbiter;
  Channels<RayPacket*> arbiter_to_traversal;
  Channels<LeafJob> traversal_to_intersection;     ///< one per pair
  Channels<LeafDone> intersection_to_traversal;    ///< one per traversal unit
  Channels<RayPacket*> traversal_to_shader;        ///< one per pair, without a shader cache
  Channels<RayPacket*> traversal_to_shader_cache;  ///< one per traversal unit
  Channels<RayPacket*> shader_cache_to_shader;     ///< one per shader unit
  std::unique_ptr<TimedChannel<FilmBatch*>> shader_to_film;
  std::unique_ptr<TimedChannel<SpawnBundle*>> spawned_rays;
};

}  // namespace sheaf
