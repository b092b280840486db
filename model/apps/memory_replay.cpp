// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/memory_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/frame_run.h"
#include "apps/shared_options.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "config/config_text.h"
#include "report/progress.h"
#include "report/replay_summary.h"
#include "report/result_folder.h"
#include "system/replay_machine.h"
#include "system/reported_values.h"

namespace sheaf {

bool shapes_memory_only(std::string_view key) {
  constexpr std::array<std::string_view, 11> kGroups{
      "crossbar.",     "node_cache.", "triangle_cache.", "attribute_cache.", "texture_cache.",
      "film_cache.",   "l2.",         "dram.",           "link.memory_",     "clock.frequency",
      "run.max_cycles"};
  return std::ranges::any_of(kGroups, [&](std::string_view g) { return key.starts_with(g); });
}

int replay_memory(const ReplayOptions& options, const Config& config, TraceReader& reader,
                  const TraceMetadata& metadata) {
  const ReplayMode mode = options.mode.value_or(ReplayMode::kElastic);
  const std::string mode_name = name_of(kReplayModes, mode);
  if (mode == ReplayMode::kElastic && !metadata.complete) {
    throw Error(ExitCode::kTrace,
                fmt::format("{}: the recorded run was cut short, so that some accesses have no end "
                            "to wait for; replay it with --mode fixed, or record a whole run",
                            reader.path().string()));
  }
  ResultFolder folder(options.out.empty() ? "result/replay" : options.out);
  folder.spare(options.trace);
  StatsTree stats;
  stats.add_text("run", RunValues::scene, metadata.scene_name);
  stats.add_text("run", RunValues::config_hash, config_hash(config));
  stats.add_text("replay", ReplayValues::mode, mode_name);
  stats.add("replay", ReplayValues::recorded_cycles, metadata.cycles);
  ReplayMachine machine(config, reader, metadata, mode);
  Progress progress;
  const bool complete = machine.run([&](Cycles now) {
    const auto all = static_cast<double>(std::max<Cycles>(1, metadata.cycles));
    progress.update(std::min(1.0, static_cast<double>(now) / all), fmt::format("cycle {}", now));
    return interrupted();
  });
  machine.report(stats);
  stats.add("run", RunValues::complete, complete ? 1 : 0);
  const std::string summary = summarize_replay(stats, metadata, mode_name);
  return finish_run({config, stats, summary, complete, "the end of the trace", options.quiet},
                    folder);
}

}  // namespace sheaf
