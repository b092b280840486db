// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace sheaf::stability {

/// One thing that differs between stiff machines: each level is the settings that make it.
struct Factor {
  std::vector<std::vector<std::string>> levels;
};

/// How far apart things are.
struct Extremes {
  std::string slow;  ///< cycles of what takes long
  std::string many;  ///< units, contexts, lanes, banks, rays of a packet
  std::vector<std::string> clocks;
};

/// The extremes of every rate, latency, size and number of the machine, and every choice of its
/// policies, such that check_config takes each combination. Left at their defaults are lines of
/// private caches, capacities (which sets and ways make), seeds of random replacement, and a DRAM's
/// single timings and mapping of addresses. Of DRAMs there are three, with few channels and ranks,
/// whose controllers take a thousand cycles at most: while a request waits in one, refreshes are
/// simulated one by one.
[[nodiscard]] std::vector<Factor> machine_factors(const Extremes& extremes);

/// Machines as settings: every combination of the levels of any `strength` factors.
[[nodiscard]] std::vector<std::vector<std::string>> covering_machines(
    const std::vector<Factor>& factors, std::size_t strength);

}  // namespace sheaf::stability
