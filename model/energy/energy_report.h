// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/config.h"
#include "stats/counter_group.h"
#include "stats/counters.h"
#include "stats/report_tree.h"
#include "system/build_plan.h"

namespace sheaf {

#define SHEAF_ENERGY_VALUES(X)                                                             \
  X(node, "", "Technology node of everything but DRAM")                                    \
  X(known, "pJ", "Sum of the items that are known; what is unknown is in no sum")          \
  X(unknown, "", "Items that have no coefficient or no count; none of them is in any sum") \
  X(per_ray, "pJ", "Known energy per ray")                                                 \
  X(power, "W", "Known energy by the length of the run; none where time is not simulated")
SHEAF_VALUES(EnergyValues, SHEAF_ENERGY_VALUES);

#define SHEAF_AREA_VALUES(X)                                          \
  X(sram_bits, "bits", "All SRAM whose size is known, tags included") \
  X(sram_mm2, "mm2", "Its area")                                      \
  X(unknown, "", "What takes area and is in no sum")
SHEAF_VALUES(AreaValues, SHEAF_AREA_VALUES);

#define SHEAF_SRAM_VALUES(X)                             \
  X(bits, "bits", "Bits of all of these, tags included") \
  X(mm2, "mm2", "Their area")
SHEAF_VALUES(SramValues, SHEAF_SRAM_VALUES);

/// Adds energy and area to the report of a finished run: counts x coefficients, item by item. What
/// has no coefficient or was not counted has no value and is named in energy.unknown.
void report_energy(const Config& config, const BuildPlan& plan, StatsTree& stats);

/// What it adds, for `sheaf counters`.
[[nodiscard]] std::vector<CounterGroup> energy_groups();

}  // namespace sheaf
