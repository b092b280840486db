// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "config/config.h"
#include "stats/report_tree.h"
#include "system/build_plan.h"

namespace sheaf {

/// Widths and numbers of things in the machine: the symbols of rtl_notes/README.md.
struct MachineSizes {
  std::uint64_t ray_bits = 0;          ///< R
  std::uint64_t hit_bits = 128;        ///< H
  std::uint64_t address_bits = 0;      ///< A
  std::uint64_t spawned_per_ray = 0;   ///< b + l
  std::uint64_t rays_in_loop = 0;      ///< S
  std::uint64_t packets_in_store = 0;  ///< S_p
};

/// `stats` has been given what the scene holds (report_scene).
[[nodiscard]] MachineSizes machine_sizes(const Config& config, const BuildPlan& plan,
                                         const StatsTree& stats);

/// One kind of SRAM, as the units' pages in rtl_notes/ have it, tags included; registers, orders of
/// replacement and MSHRs are not.
struct Sram {
  std::string_view name;
  std::uint64_t count = 1;            ///< of them in the machine
  std::optional<std::uint64_t> bits;  ///< of one; none where it has no bound that could be built
  std::uint64_t banks = 1;            ///< of one; an access wakes one of them

  /// Energy of 64 bits, pJ.
  [[nodiscard]] std::optional<double> word_picojoule() const;
};

/// What the machine is built with, in the order of the pages.
[[nodiscard]] std::vector<Sram> list_srams(const Config& config, const BuildPlan& plan,
                                           const MachineSizes& sizes);

}  // namespace sheaf
