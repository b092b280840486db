// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "channels/clock_domain.h"
#include "stats/report_tree.h"
#include "system/build_plan.h"
#include "system/frame.h"
#include "system/memory_system.h"
#include "system/prepared_scene.h"
#include "system/run_hooks.h"
#include "units/film_unit.h"
#include "units/intersection_unit.h"
#include "units/packet_arbiter.h"
#include "units/primary_source.h"
#include "units/ray_cache_unit.h"
#include "units/shader_cache_unit.h"
#include "units/shader_unit.h"
#include "units/spawn_router.h"
#include "units/traversal_unit.h"

namespace sheaf {

using PacketChannel = TimedChannel<RayPacket*>;

/// The machine that a configuration describes, built for one scene: units, channels and memory,
/// bound and ready to run once. One machine a process (SystemC).
class Machine {
 public:
  Machine(const Config& config, const BuildPlan& plan, const PreparedScene& scene, Frame& frame,
          const RunHooks& hooks = {});
  ~Machine();

  /// Called now and then with the share of the tiles that have been begun; returns true to stop.
  using Monitor = std::function<bool(double progress, Cycles now)>;

  /// Runs until all is done, the monitor says stop or max_cycles is reached. Returns true if the
  /// frame is complete. Throws Error(kStuck) naming the stuck units if the machine can make no
  /// progress, Error(kBug) if a conservation check fails.
  bool run(const Monitor& monitor);

  void report(StatsTree& stats) const;

  [[nodiscard]] ClockDomain& clock_domain() { return domain_; }

 private:
  struct Links;
  void build_units();
  void build_regrouper();
  void connect();
  void connect_shaders();
  void record_memory(MemoryRecorder& recorder);
  void connect_shader_cache();
  void check_conservation() const;
  [[nodiscard]] std::string describe_stuck() const;
  void finish_accounts(Cycles end);
  void report_units(StatsTree& stats) const;
  void report_memory(StatsTree& stats) const;
  void report_links(StatsTree& stats) const;

  const Config config_;
  const BuildPlan plan_;
  const PreparedScene& scene_;
  Frame& frame_;
  PacketPool packets_;
  ObjectPool<SpawnBundle> bundles_;
  ObjectPool<FilmBatch> batches_;
  PacketShader shader_;
  const RunHooks hooks_;
  FlowControl flow_;
  ClockDomain domain_;
  MemorySystem memory_;
  std::unique_ptr<Links> links_;
  std::vector<std::unique_ptr<TraversalUnit>> traversal_units_;
  std::vector<std::unique_ptr<IntersectionUnit>> intersection_units_;
  std::vector<std::unique_ptr<ShaderUnit>> shader_units_;
  std::unique_ptr<PrimarySource> primary_source_;
  std::unique_ptr<PacketArbiter> packet_arbiter_;
  std::unique_ptr<RayCacheUnit> ray_cache_;
  std::unique_ptr<SpawnRouter> spawn_router_;
  std::unique_ptr<ShaderCacheUnit> shader_cache_;
  std::unique_ptr<FilmUnit> film_;
  Cycles end_ = 0;
  bool complete_ = false;
};

}  // namespace sheaf
