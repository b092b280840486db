// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "config/dram/device.h"
#include "memory/dram/channel_stats.h"

namespace sheaf {

/// One item of a memory's energy; none if no source gives its coefficient.
struct DramEnergyItem {
  std::string_view name;
  std::optional<double> picojoule;
  std::string_view meaning;
};

/// What the counted commands and standby times cost, item by item. `end`: length of the run, tCK.
[[nodiscard]] std::vector<DramEnergyItem> dram_energy(const DramDevice& device,
                                                      const DramChannelStats& counts, Cycles end);

/// The items that are known, added up.
[[nodiscard]] double known_energy(const std::vector<DramEnergyItem>& items);

}  // namespace sheaf
