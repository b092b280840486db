// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/energy.h"

namespace sheaf {
namespace {

std::optional<double> times(const std::optional<double>& each, std::uint64_t count) {
  if (!each) return std::nullopt;
  return *each * static_cast<double>(count);
}

}  // namespace

std::vector<DramEnergyItem> dram_energy(const DramDevice& device, const DramChannelStats& counts,
                                        Cycles end) {
  const DramEnergyTable& table = device.energy;
  const std::uint64_t ranks =
      std::uint64_t{device.organization.channels} * device.organization.ranks;
  const std::uint64_t all = ranks * end;
  const std::uint64_t idle = all - counts.active_cycles;
  const double ns = 1e9 / static_cast<double>(device.clock_hz);
  const auto standby = [&](const std::optional<double>& milliwatt, std::uint64_t cycles) {
    return milliwatt ? times(*milliwatt * ns, cycles) : std::nullopt;  // mW x ns = pJ
  };
  return {
      {DramEnergyValues::activate_precharge,
       times(table.activate_precharge_pj, counts.num_activates)},
      {DramEnergyValues::read, times(table.read_pj, counts.num_read_bursts)},
      {DramEnergyValues::write, times(table.write_pj, counts.num_write_bursts)},
      {DramEnergyValues::refresh, times(table.refresh_pj, counts.num_refreshes)},
      {DramEnergyValues::active_standby, standby(table.active_standby_mw, counts.active_cycles)},
      {DramEnergyValues::precharge_standby, standby(table.precharge_standby_mw, idle)}};
}

double known_energy(const std::vector<DramEnergyItem>& items) {
  double sum = 0;
  for (const DramEnergyItem& item : items) sum += item.picojoule.value_or(0);
  return sum;
}

}  // namespace sheaf
