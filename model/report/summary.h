// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "config/config.h"
#include "stats/report_tree.h"
#include "system/build_plan.h"

namespace sheaf {

struct WallTimes {
  double load = 0.0;   ///< seconds to read the scene
  double build = 0.0;  ///< seconds to build the kd-tree
  double run = 0.0;    ///< seconds to simulate
};

struct SummaryInput {
  const Config& config;
  const BuildPlan& plan;
  const StatsTree& stats;
  bool complete = false;
  WallTimes wall;
};

/// One page for people: what was simulated, how fast the machine is, where its cycles and bytes
/// went, how coherent the packets were and what was left out.
[[nodiscard]] std::string summarize(const SummaryInput& input);

}  // namespace sheaf
