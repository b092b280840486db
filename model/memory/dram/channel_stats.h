// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "stats/counters.h"

namespace sheaf {

// Every queued request ends as exactly one of row hit, miss or conflict. A request for bursts in
// more than one row or channel counts there once each.
#define SHEAF_DRAM_CHANNEL_COUNTERS(X)                                                          \
  X(num_reads, "requests", "Reads taken into the queue")                                        \
  X(num_writes, "requests", "Writes taken into the queue")                                      \
  X(num_forwarded, "requests", "Reads answered from a queued write, with no access")            \
  X(num_merged, "requests", "Writes that replaced a queued write, with no access of their own") \
  X(num_row_hits, "requests", "Requests that met their row open")                               \
  X(num_row_misses, "requests", "Requests whose bank had no row open")                          \
  X(num_row_conflicts, "requests", "Requests that had another row closed first")                \
  X(num_activates, "commands", "Rows opened")                                                   \
  X(num_precharges, "commands", "Rows closed, by refreshes and auto-precharges too")            \
  X(num_read_bursts, "commands", "Bursts read")                                                 \
  X(num_write_bursts, "commands", "Bursts written")                                             \
  X(num_refreshes, "commands", "Refreshes of all banks of a rank")                              \
  X(num_turnarounds, "events", "Times the data bus changed its direction")                      \
  X(bus_busy_cycles, "tCK", "Cycles in which the data bus moved data")                          \
  X(active_cycles, "tCK", "Cycles in which a rank had a row open, summed over ranks")           \
  X(refresh_cycles, "tCK", "Cycles that ranks spent refreshing, summed over ranks")             \
  X(sum_queue_residence, "tCK", "Time in the queue, acceptance to last column command, summed") \
  X(queue_occupancy_cycles, "tCK", "Queued requests, summed over all cycles")                   \
  X(max_queued, "requests", "Most requests queued at a time")
SHEAF_STATS(DramChannelStats, SHEAF_DRAM_CHANNEL_COUNTERS);

}  // namespace sheaf
