// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "config/dram/device.h"
#include "memory/dram/channel_stats.h"
#include "stats/report_tree.h"

namespace sheaf {

/// Adds a memory's counters, the ratios that follow from them, and its energy item by item to a
/// report, below `path`. `end`: length of the run in tCK.
void report_dram(const std::string& path, const DramDevice& device, const DramChannelStats& counts,
                 Cycles end, StatsTree& stats);

}  // namespace sheaf
