// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "sorting/ray_sorter.h"
#include "sorting/shading_sorter.h"
#include "stats/counter_group.h"
#include "stats/report_tree.h"
#include "system/build_plan.h"
#include "system/prepared_scene.h"
#include "traversal/trace.h"
#include "units/ray_counts.h"

namespace sheaf {

// Parts of the report that the timed machine and the untimed pipeline share.

/// Ray cache: counters, ratios, how full packets left.
void report_sorter(const RaySorter& sorter, const std::string& path, StatsTree& stats);

/// Shader cache: counters and ratios.
void report_shading_sorter(const ShadingSorter& sorter, const std::string& path, StatsTree& stats);

/// Packet and lane counts, p_t and p_i, of primary and, if there are any, of secondary rays.
void report_traces(const TraceCounts& primary, const TraceCounts& secondary, bool has_secondary,
                   StatsTree& stats);

/// Rays by kind and depth.
void report_rays(const RayCounts& rays, StatsTree& stats);

/// What was built of the scene, and what was left out and why.
void report_scene(const PreparedScene& scene, const BuildPlan& plan, StatsTree& stats);

/// Every counter that a run can report, by the unit that owns it.
[[nodiscard]] std::span<const CounterGroup> counter_groups();

}  // namespace sheaf
