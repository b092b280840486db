// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "sorting/spawn_bundle.h"
#include "units/messages.h"
#include "units/shader_unit.h"

namespace sheaf {

/// All links between the units of a machine, by what they join.
template <template <typename> typename Link>
struct MachineLinks {
  template <typename T>
  using Channels = std::vector<std::unique_ptr<Link<T>>>;

  std::unique_ptr<Link<RayPacket*>> source_to_arbiter;
  std::unique_ptr<Link<RayPacket*>> packet_fifo;
  std::unique_ptr<Link<ContextFree>> traversal_to_arbiter;
  Channels<RayPacket*> arbiter_to_traversal;
  Channels<LeafJob> traversal_to_intersection;     ///< one per pair
  Channels<LeafDone> intersection_to_traversal;    ///< one per traversal unit
  Channels<RayPacket*> traversal_to_shader;        ///< one per pair, without a shader cache
  Channels<RayPacket*> traversal_to_shader_cache;  ///< one per traversal unit
  Channels<RayPacket*> shader_cache_to_shader;     ///< one per shader unit
  std::unique_ptr<Link<FilmBatch*>> shader_to_film;
  std::unique_ptr<Link<SpawnBundle*>> spawned_rays;
  std::unique_ptr<Link<SpawnBundle*>> spill_to_regrouper;  ///< only with a spill unit

  /// Calls f(link) for each that has been built.
  template <typename F>
  void for_each(F&& f) const {
    const auto one = [&](const auto& link) {
      if (link) f(*link);
    };
    const auto all = [&](const auto& links) {
      for (const auto& link : links) f(*link);
    };
    one(source_to_arbiter);
    one(packet_fifo);
    one(traversal_to_arbiter);
    all(arbiter_to_traversal);
    all(traversal_to_intersection);
    all(intersection_to_traversal);
    all(traversal_to_shader);
    all(traversal_to_shader_cache);
    all(shader_cache_to_shader);
    one(shader_to_film);
    one(spawned_rays);
    one(spill_to_regrouper);
  }
};

}  // namespace sheaf
