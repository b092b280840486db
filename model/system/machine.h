// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <systemc>

#include "channels/clock_domain.h"
#include "system/machine_observer.h"
#include "system/machine_parts.h"
#include "system/memory_system.h"
#include "system/tag_hierarchy.h"
#include "units/film_unit.h"
#include "units/intersection_unit.h"
#include "units/packet_arbiter.h"
#include "units/primary_source.h"
#include "units/ray_cache_unit.h"
#include "units/shader_cache_unit.h"
#include "units/shader_unit.h"
#include "units/spawn_router.h"
#include "units/spill_unit.h"
#include "units/traversal_unit.h"

namespace sheaf {

using PacketChannel = TimedChannel<RayPacket*>;

/// Event-driven units that meet in one clock domain.
struct TimedKind {
  template <typename T>
  using Link = TimedChannel<T>;
  using TraversalUnit = sheaf::TraversalUnit;
  using IntersectionUnit = sheaf::IntersectionUnit;
  using ShaderUnit = sheaf::ShaderUnit;
  using PrimarySource = sheaf::PrimarySource;
  using PacketArbiter = sheaf::PacketArbiter;
  using RayCache = RayCacheUnit;
  using SpawnRouter = sheaf::SpawnRouter;
  using Spill = SpillUnit;
  using ShaderCache = ShaderCacheUnit;
  using Film = FilmUnit;
  using Memory = MemorySystem;
};

/// The machine that a configuration describes, built for one scene: units, channels and memory,
/// bound and ready to run once. One machine a process (SystemC).
class Machine : public MachineParts<TimedKind> {
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

  /// Adds an observer; to be called before run().
  void observe(MachineObserver& observer);

  /// What has been counted up to now, or, after the run, in all.
  [[nodiscard]] Observation observation(Cycles now) const;
  /// Makes the caches hold what `tags` says, but for what is on its way; nothing is counted. For a
  /// run that leaves something out.
  void load_caches(const TagHierarchy& tags);
  /// Length of the run, once it has ended.
  [[nodiscard]] Cycles end() const { return end_; }

  [[nodiscard]] ClockDomain& clock_domain() { return domain_; }

 private:
  void build_units();
  void build_regrouper();
  void build_spill();
  void connect();
  void connect_shaders();
  void record_memory(MemoryRecorder& recorder);
  void connect_shader_cache();
  [[nodiscard]] std::string describe_stuck() const;
  [[nodiscard]] MachineProbes probes();
  void probe_units(MachineProbes& probes) const;
  void probe_links(MachineProbes& probes) const;

  ClockDomain domain_;
  std::vector<MachineObserver*> observers_;
};

}  // namespace sheaf
