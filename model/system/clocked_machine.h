// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "system/clocked_memory.h"
#include "system/machine_parts.h"
#include "units/clocked/film.h"
#include "units/clocked/intersection_unit.h"
#include "units/clocked/packet_arbiter.h"
#include "units/clocked/primary_source.h"
#include "units/clocked/ray_cache.h"
#include "units/clocked/shader_cache.h"
#include "units/clocked/shader_unit.h"
#include "units/clocked/spawn_router.h"
#include "units/clocked/spill_unit.h"
#include "units/clocked/traversal_unit.h"

namespace sheaf {

/// Units that tick in every cycle.
struct ClockedKind {
  template <typename T>
  using Link = clocked::Link<T>;
  using TraversalUnit = clocked::TraversalUnit;
  using IntersectionUnit = clocked::IntersectionUnit;
  using ShaderUnit = clocked::ShaderUnit;
  using PrimarySource = clocked::PrimarySource;
  using PacketArbiter = clocked::PacketArbiter;
  using RayCache = clocked::RayCache;
  using SpawnRouter = clocked::SpawnRouter;
  using Spill = clocked::SpillUnit;
  using ShaderCache = clocked::ShaderCache;
  using Film = clocked::FilmUnit;
  using Memory = ClockedMemory;
};

/// The reference for Machine: the same machine with a clock. In every cycle every unit ticks, in
/// one fixed order; units meet only through links that take at least a cycle. Nothing is skipped,
/// nothing runs ahead, and no simulation kernel is needed.
class ClockedMachine : public MachineParts<ClockedKind> {
 public:
  ClockedMachine(const Config& config, const BuildPlan& plan, const PreparedScene& scene,
                 Frame& frame, const RunHooks& hooks = {});

  /// As Machine::run.
  using Monitor = std::function<bool(double progress, Cycles now)>;
  bool run(const Monitor& monitor);

 private:
  template <typename T>
  using Channels = std::vector<std::unique_ptr<clocked::Link<T>>>;

  void build_units();
  void build_regrouper();
  void build_spill();
  void connect();
  void connect_shaders();
  void list_units();
  template <typename T>
  clocked::Link<T>& add_link(Channels<T>& links, const std::string& name);

  void tick(Cycles now);
  [[nodiscard]] bool is_at_rest() const;
  [[nodiscard]] bool is_still(Cycles now) const;
  void check_progress(Cycles now);
  [[nodiscard]] std::string describe_stuck(Cycles now) const;
  std::vector<clocked::Unit*> units_;  ///< in the order in which they tick
  Cycles still_since_ = kNever;
};

}  // namespace sheaf
