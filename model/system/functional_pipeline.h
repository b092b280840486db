// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "scene/tile_order.h"
#include "sorting/shading_sorter.h"
#include "system/build_plan.h"
#include "system/frame.h"
#include "system/functional_observer.h"
#include "system/observation.h"
#include "system/prepared_scene.h"
#include "system/run_hooks.h"
#include "units/shader_unit.h"

namespace sheaf {

/// The same pipeline without time: packets are traced and shaded one after the other, in the order
/// that the arbiter's policy gives, with the same flow control and the same ray cache. Private to
/// it is only that nothing waits. An observer, which may be null, is told of each step.
class FunctionalPipeline {
 public:
  FunctionalPipeline(const Config& config, const BuildPlan& plan, const PreparedScene& scene,
                     Frame& frame, const RunHooks& hooks = {},
                     FunctionalObserver* observer = nullptr);

  /// Called once a tile with the share of the tiles that have been begun; returns true to stop.
  using Monitor = std::function<bool(double progress)>;
  /// Returns true if the frame is complete; after a stop it goes on from there.
  bool run(const Monitor& monitor);

  void report(StatsTree& stats) const;
  /// Adds p_t's counts and the ray cache's hits so far.
  void observe(Observation& seen) const;
  [[nodiscard]] const TraceCounts& primary_counts() const { return primary_counts_; }
  [[nodiscard]] const TraceCounts& secondary_counts() const { return secondary_counts_; }
  [[nodiscard]] std::size_t packets_made() const { return packets_.num_made(); }

 private:
  bool next_primary(RayPacket*& packet);
  void process(RayPacket* packet, TraceCounts& counts);
  void shade(RayPacket* packet);
  void retire(const RayPacket& packet);
  void spawn();
  bool sweep();
  bool sweep_shader_cache();

  const Config config_;
  const BuildPlan plan_;
  const PreparedScene& scene_;
  Frame& frame_;
  PacketPool packets_;
  PacketShader shader_;
  ShadingSource& shading_source_;
  FunctionalObserver* const observer_;
  FlowControl flow_;
  TileOrder order_;
  std::unique_ptr<RaySorter> sorter_;
  std::unique_ptr<ShadingSorter> shading_sorter_;
  std::vector<RayPacket*> to_shade_;
  std::deque<RayPacket*> fifo_;
  std::vector<RayPacket*> departures_;
  RayPacket* held_primary_ = nullptr;  ///< made, but not admitted yet
  PacketShading shading_;
  LaneCounts lanes_{};
  TraceLog log_;
  std::uint32_t last_tile_ = ~0U;    ///< of the packet admitted last
  std::uint32_t num_monitored_ = 0;  ///< tiles begun, as the monitor knows
  TraceCounts primary_counts_;
  TraceCounts secondary_counts_;
  bool last_was_secondary_ = true;
};

}  // namespace sheaf
