// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/dram_report.h"

#include <limits>

#include "memory/dram/energy.h"

namespace sheaf {

void report_dram(const std::string& path, const DramDevice& device, const DramChannelStats& counts,
                 Cycles end, StatsTree& stats) {
  stats.add_text(path + ".model", std::string(device.name), "Preset of the memory");
  stats.add(path + ".clock", device.clock_hz, "Hz", "Memory clock, 1 / tCK");
  stats.add(path + ".memory_cycles", end, "tCK", "Length of the run in memory cycles");
  const std::string channels = path + ".channels";
  stats.add_counters(channels, counts);
  const std::uint64_t served =
      counts.num_row_hits + counts.num_row_misses + counts.num_row_conflicts;
  stats.add_ratio(path + ".row_hit_rate", counts.num_row_hits, served, "1",
                  "Row hits per queued request");
  stats.add_ratio(path + ".mean_queue_residence", counts.sum_queue_residence, served, "tCK",
                  "Mean time of a request in its queue");
  stats.add_ratio(path + ".mean_queued", counts.queue_occupancy_cycles,
                  end * device.organization.channels, "requests",
                  "Mean number of requests in the queues of a channel");
  const std::vector<DramEnergyItem> items = dram_energy(device, counts, end);
  for (const DramEnergyItem& item : items) {
    stats.add_real(path + ".energy." + std::string(item.name),
                   item.picojoule.value_or(std::numeric_limits<double>::quiet_NaN()), "pJ",
                   std::string(item.meaning) + "; none: no source gives it");
  }
  stats.add_real(path + ".energy.known", known_energy(items), "pJ",
                 "Sum of the items that are known; Vpp, termination and controller are in none");
  stats.add_text(path + ".energy.source", std::string(device.energy.source),
                 "Where the coefficients are from");
}

}  // namespace sheaf
