// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/dram_report.h"

namespace sheaf {

void report_dram(const std::string& path, const DramDevice& device, const DramChannelStats& counts,
                 Cycles end, StatsTree& stats) {
  stats.add_text(path, BankedMemoryValues::model, std::string(device.name));
  stats.add(path, BankedMemoryValues::clock, device.clock_hz);
  stats.add(path, BankedMemoryValues::memory_cycles, end);
  const std::string channels = path + ".channels";
  stats.add_counters(channels, counts);
  const std::uint64_t served =
      counts.num_row_hits + counts.num_row_misses + counts.num_row_conflicts;
  stats.add_ratio(path, BankedMemoryValues::row_hit_rate, counts.num_row_hits, served);
  stats.add_ratio(path, BankedMemoryValues::mean_queue_residence, counts.sum_queue_residence,
                  served);
  stats.add_ratio(path, BankedMemoryValues::mean_queued, counts.queue_occupancy_cycles,
                  end * device.organization.channels);
  const std::vector<DramEnergyItem> items = dram_energy(device, counts, end);
  const std::string energy = path + ".energy";
  for (const DramEnergyItem& item : items) stats.add_real(energy, item.what, item.picojoule);
  stats.add_real(energy, DramEnergyValues::known, known_energy(items));
  stats.add_text(energy, DramEnergyValues::source, std::string(device.energy.source));
}

}  // namespace sheaf
