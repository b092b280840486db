// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "config/dram/device.h"

namespace sheaf {

/// What a standard and its data sheets say of one kind of memory.
struct DramPreset {
  DramModel model{};
  std::string_view name;
  std::string_view timing_source;
  std::string_view mapping;
  std::uint64_t clock_hz = 0;
  DramOrganization organization;
  bool separate_row_bus = false;
  DramTiming timing;
  DramEnergyTable energy;
};

[[nodiscard]] std::span<const DramPreset> dram_presets();

}  // namespace sheaf
