// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/observation.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/errors.h"

namespace sheaf {
namespace {

constexpr const char* kTimelineName = "timeline.perfetto-trace";
constexpr const char* kSignalsName = "signals.vcd";

WatchWindow window_of(const WatchOptions& options) {
  WatchWindow window;
  if (!options.window.empty()) {
    const std::optional<WatchWindow> parsed = WatchWindow::parse(options.window);
    if (!parsed) {
      throw Error(ExitCode::kUsage,
                  fmt::format("--timeline-window {}: give cycles as FIRST..END with FIRST < END, "
                              "for example 10000..20000",
                              options.window));
    }
    window = *parsed;
  }
  window.every = options.every;
  window.max_events = options.max_events;
  return window;
}

}  // namespace

void declare_observation(CLI::App& command, WatchOptions& options) {
  command.add_flag("--timeline", options.timeline,
                   "Also write what every unit does, cycle by cycle, for ui.perfetto.dev: "
                   "timeline.perfetto-trace");
  command
      .add_option("--vcd", options.vcd,
                  "Also write the signals of a unit, such as traversal_unit0, as signals.vcd")
      ->type_name("UNIT");
  command
      .add_option("--timeline-window", options.window,
                  "Cycles that these two take, the last one not included; without a number: to the "
                  "end")
      ->type_name("FIRST..END");
  command
      .add_option("--timeline-every", options.every,
                  fmt::format("Take one of so many stretches of {} cycles (default 1: all)",
                              WatchWindow::kStretch))
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
  command
      .add_option("--timeline-events", options.max_events,
                  "Most events to be written (default 1000000, some 30 MB)")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
}

void check_observation(const WatchOptions& options, const Config& config) {
  if (!options.wanted()) {
    const WatchOptions untouched;
    if (options.window != untouched.window || options.every != untouched.every ||
        options.max_events != untouched.max_events) {
      throw Error(ExitCode::kUsage,
                  "--timeline-…: nothing is recorded without --timeline or --vcd");
    }
    return;
  }
  const char* const wish = options.timeline ? "--timeline" : "--vcd";
  if (config.run.fidelity != Fidelity::kTimed) {
    throw Error(ExitCode::kUsage,
                fmt::format("{}: there are cycles to be shown only in a timed run; set "
                            "run.fidelity=timed",
                            wish));
  }
  static_cast<void>(window_of(options));
}

Observation::Observation(const WatchOptions& options, ResultFolder& folder) {
  if (options.timeline) timeline_.emplace(folder.stage(kTimelineName), window_of(options));
  if (!options.vcd.empty()) {
    vcd_.emplace(folder.stage(kSignalsName), options.vcd, window_of(options));
  }
}

std::vector<MachineObserver*> Observation::observers() {
  std::vector<MachineObserver*> all;
  if (timeline_) all.push_back(&*timeline_);
  if (vcd_) all.push_back(&*vcd_);
  return all;
}

void Observation::tell() const {
  if (!timeline_ || !timeline_->cut_at()) return;
  std::fputs(fmt::format("sheaf: note: the timeline ends at cycle {}, where it has as many events "
                         "as it may have; see --timeline-window, --timeline-every and "
                         "--timeline-events\n",
                         *timeline_->cut_at())
                 .c_str(),
             stderr);
}

}  // namespace sheaf
