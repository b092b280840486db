// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "stats/report_tree.h"
#include "system/build_plan.h"
#include "system/frame.h"
#include "system/machine_links.h"
#include "system/prepared_scene.h"
#include "system/run_hooks.h"
#include "units/flow_control.h"

namespace sheaf {

/// What a machine is made of, whichever way its time is simulated, with the report and the
/// conservation checks, which are the same for all. `Kind` names the types of units, links and
/// memory; they count with the same structs and show them by the same names.
template <typename Kind>
class MachineParts {
 public:
  MachineParts(const MachineParts&) = delete;
  MachineParts& operator=(const MachineParts&) = delete;
  void report(StatsTree& stats) const;

 protected:
  MachineParts(const Config& config, const BuildPlan& plan, const PreparedScene& scene,
               Frame& frame, RunHooks hooks);
  ~MachineParts();

  void finish_accounts(Cycles end);
  /// Throws Error(kBug) if one fails.
  void check_conservation() const;

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
  MachineLinks<Kind::template Link> links_;
  std::vector<std::unique_ptr<typename Kind::TraversalUnit>> traversal_units_;
  std::vector<std::unique_ptr<typename Kind::IntersectionUnit>> intersection_units_;
  std::vector<std::unique_ptr<typename Kind::ShaderUnit>> shader_units_;
  std::unique_ptr<typename Kind::PrimarySource> primary_source_;
  std::unique_ptr<typename Kind::PacketArbiter> packet_arbiter_;
  std::unique_ptr<typename Kind::RayCache> ray_cache_;
  std::unique_ptr<typename Kind::SpawnRouter> spawn_router_;
  std::unique_ptr<typename Kind::Spill> spill_;
  std::unique_ptr<typename Kind::ShaderCache> shader_cache_;
  std::unique_ptr<typename Kind::Film> film_;
  std::unique_ptr<typename Kind::Memory> memory_;
  Cycles end_ = 0;
  bool complete_ = false;
  std::uint64_t num_wakes_ = 0;

 private:
  void report_units(StatsTree& stats) const;
  void report_memory(StatsTree& stats) const;
  void report_links(StatsTree& stats) const;
};

}  // namespace sheaf
