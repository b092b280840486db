// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "config/dram/device.h"
#include "memory/dram/channel_stats.h"

namespace sheaf {

#define SHEAF_DRAM_ENERGY_VALUES(X)                                                              \
  X(activate_precharge, "pJ", "Rows opened and closed")                                          \
  X(read, "pJ", "Bursts read")                                                                   \
  X(write, "pJ", "Bursts written")                                                               \
  X(refresh, "pJ", "Refreshes of all banks")                                                     \
  X(active_standby, "pJ", "Standby with a row open")                                             \
  X(precharge_standby, "pJ", "Standby with all rows closed")                                     \
  X(known, "pJ", "Sum of the items that are known; Vpp, termination and controller are in none") \
  X(source, "", "Where the coefficients are from")
SHEAF_VALUES(DramEnergyValues, SHEAF_DRAM_ENERGY_VALUES);

/// One item of a memory's energy; none if no source gives its coefficient.
struct DramEnergyItem {
  CounterInfo what;
  std::optional<double> picojoule;
};

/// What the counted commands and standby times cost, item by item. `end`: length of the run, tCK.
[[nodiscard]] std::vector<DramEnergyItem> dram_energy(const DramDevice& device,
                                                      const DramChannelStats& counts, Cycles end);

/// The items that are known, added up.
[[nodiscard]] double known_energy(const std::vector<DramEnergyItem>& items);

}  // namespace sheaf
