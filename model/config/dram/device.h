// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "config/dram/address_map.h"
#include "config/dram/settings.h"

namespace sheaf {

/// Energies of a rank's commands, as far as a source gives them; what it does not is unknown.
struct DramEnergyTable {
  std::optional<double> activate_precharge_pj;  ///< one activation with its precharge
  std::optional<double> read_pj, write_pj;      ///< one burst, interface as the source counts it
  std::optional<double> refresh_pj;             ///< one refresh of all banks
  std::optional<double> active_standby_mw;      ///< a row is open somewhere
  std::optional<double> precharge_standby_mw;   ///< no row is open
  std::string_view source;
};

/// A memory system with every value resolved: preset, overrides, checks.
struct DramDevice {
  std::string_view name;
  std::string_view timing_source;
  std::uint64_t clock_hz = 0;  ///< of tCK
  DramOrganization organization;
  bool separate_row_bus = false;  ///< row and column commands have a bus each (HBM)
  DramTiming timing;
  DramEnergyTable energy;
  AddressMap map;

  PagePolicy page{};
  std::uint32_t read_queue = 0, write_queue = 0;
  std::uint32_t write_high = 0, write_low = 0;
  std::uint32_t row_hit_cap = 0;
  std::uint32_t controller_latency = 0;
  bool refresh = true;

  /// Bytes a second that all data buses can move.
  [[nodiscard]] double peak_bandwidth() const {
    return static_cast<double>(organization.channels) * organization.burst_bytes / timing.tBL *
           static_cast<double>(clock_hz);
  }
};

/// The device that dram.* describes; dram.model must not be fixed. Throws Error(kUsage) with one
/// line that names the rule a combination of values breaks.
[[nodiscard]] DramDevice resolve_dram(const DramSpec& spec);

/// "DDR4-2400", or "fixed".
[[nodiscard]] std::string_view to_string(DramModel model);

}  // namespace sheaf
