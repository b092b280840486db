// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "report/result_folder.h"
#include "report/timeline.h"
#include "report/vcd_trace.h"

namespace CLI {
class App;
}

namespace sheaf {

/// What else is to be written of a run, cycle by cycle.
struct WatchOptions {
  bool timeline = false;
  std::string vcd;     ///< a unit's name; empty: none
  std::string window;  ///< cycles, as WatchWindow::parse has them; empty: all
  std::uint64_t every = 1;
  std::uint64_t max_events = 1'000'000;

  [[nodiscard]] bool wanted() const { return timeline || !vcd.empty(); }
};

/// Declares --timeline, --vcd and what says how much of a run they take.
void declare_observation(CLI::App& command, WatchOptions& options);

/// Throws Error(kUsage) with what is wrong with the options.
void check_observation(const WatchOptions& options, const Config& config);

/// The observers of a run, which write their files into its folder.
class Observation {
 public:
  Observation(const WatchOptions& options, ResultFolder& folder);

  [[nodiscard]] std::vector<MachineObserver*> observers();
  /// After the run: says on standard error if a timeline is not all that was asked for.
  void tell() const;

 private:
  std::optional<Timeline> timeline_;
  std::optional<VcdTrace> vcd_;
};

}  // namespace sheaf
