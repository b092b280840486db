// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "config/dram/device.h"
#include "memory/dram/channel_stats.h"
#include "memory/dram/energy.h"
#include "stats/report_tree.h"

namespace sheaf {

#define SHEAF_BANKED_MEMORY_VALUES(X)                                   \
  X(model, "", "Preset of the memory")                                  \
  X(clock, "Hz", "Memory clock, 1 / tCK")                               \
  X(memory_cycles, "tCK", "Length of the run in memory cycles")         \
  X(row_hit_rate, "1", "Row hits per queued request")                   \
  X(mean_queue_residence, "tCK", "Mean time of a request in its queue") \
  X(mean_queued, "requests", "Mean number of requests in the queues of a channel")
SHEAF_VALUES(BankedMemoryValues, SHEAF_BANKED_MEMORY_VALUES);

/// Adds a memory's counters, the ratios that follow from them, and its energy item by item to a
/// report, below `path`. `end`: length of the run in tCK.
void report_dram(const std::string& path, const DramDevice& device, const DramChannelStats& counts,
                 Cycles end, StatsTree& stats);

}  // namespace sheaf
