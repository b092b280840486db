// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "stats/report_tree.h"
#include "system/build_plan.h"
#include "system/frame.h"
#include "system/machine_observer.h"
#include "system/prepared_scene.h"
#include "system/run_hooks.h"

namespace sheaf {

struct FrameSimulation {
  const Config& config;  ///< run.fidelity says how
  const BuildPlan& plan;
  const PreparedScene& scene;
  RunHooks hooks = {};                                ///< not at fidelity sampled
  std::vector<MachineObserver*> observers = {};       ///< at fidelities timed and decoupled
  std::function<bool()> stop = [] { return false; };  ///< asked now and then
};

/// Simulates at any fidelity, with progress on a terminal; fills the frame and the statistics.
/// Returns true if the frame is complete. Once a process for what uses SystemC.
bool simulate_frame(const FrameSimulation& given, Frame& frame, StatsTree& stats);

}  // namespace sheaf
