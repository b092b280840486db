// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/replay_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

#include "apps/exit_codes.h"
#include "apps/frame_run.h"
#include "apps/memory_replay.h"
#include "apps/parent_death.h"
#include "apps/shared_options.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "base/text.h"
#include "config/config_text.h"
#include "tracefile/ray_lookup.h"
#include "tracefile/recorded_config.h"
#include "tracefile/scene_hash.h"
#include "tracefile/trace_metadata.h"
#include "tracefile/traced_shading.h"

namespace sheaf {
namespace {

/// Parameters on which the recorded rays depend.
bool shapes_rays(std::string_view key) {
  constexpr std::array<std::string_view, 6> kGroups{"image.width", "image.height", "scene.",
                                                    "camera.",     "light.",       "render."};
  return std::ranges::any_of(kGroups, [&](std::string_view g) { return key.starts_with(g); });
}

/// The recorded configuration with what the user sets over it, if the trace allows that.
template <typename Forbidden>
Config replay_config(const ReplayOptions& options, const RecordedConfig& recorded,
                     const char* recorded_things, const Forbidden& is_forbidden) {
  Config config = resolve_config_over(recorded.base, options.config, options.settings);
  for (const std::string& key : changed_keys(recorded.config, config)) {
    if (key == "image.heat_maps") {
      throw Error(ExitCode::kUsage,
                  fmt::format("{}: a replay makes no pictures; leave image.heat_maps as it was "
                              "recorded, or simulate the scene with sheaf run",
                              options.trace.string()));
    }
    if (!is_forbidden(key)) continue;
    throw Error(ExitCode::kUsage,
                fmt::format("{}: the recorded {} depend on {}; leave it as it was recorded, or "
                            "record a trace with the other value",
                            options.trace.string(), recorded_things, key));
  }
  return config;
}

/// The trace in the shader's place.
class RayReplay final : public FrameGuest {
 public:
  RayReplay(TraceReader& reader, const Config& config, const PreparedScene& scene,
            const std::filesystem::path& file)
      : lookup_(reader, config.image.width, config.image.height),
        shading_(scene.scene, config.render.recursion_level, lookup_) {
    if (scene_hash(scene.scene) == reader.identity().scene_hash) return;
    throw Error(ExitCode::kTrace,
                fmt::format("{}: {} is not the scene that it was recorded from; name that scene "
                            "with --scene, or record again",
                            reader.path().string(), file.string()));
  }

  [[nodiscard]] RunHooks hooks() override { return {&shading_}; }
  [[nodiscard]] bool failed() const override { return shading_.failed(); }
  void finish(bool /*complete*/, const StatsTree& /*stats*/) override { shading_.rethrow(); }

 private:
  RayLookup lookup_;
  TracedShading shading_;
};

std::filesystem::path scene_file(const ReplayOptions& options, const TraceMetadata& metadata) {
  if (options.scene) return *options.scene;
  if (std::filesystem::exists(metadata.scene_path)) return metadata.scene_path;
  throw Error(
      ExitCode::kUsage,
      fmt::format("{}: was recorded from {}, which is not here; name the scene with --scene",
                  options.trace.string(), printable(metadata.scene_path)));
}

int replay_rays(const ReplayOptions& options, TraceReader& reader, const TraceMetadata& metadata) {
  const Config config =
      replay_config(options, recorded_config(reader, metadata), "rays", shapes_rays);
  if (options.mode) {
    throw Error(ExitCode::kUsage,
                fmt::format("{}: holds rays, which are simulated in time; --mode is for a trace of "
                            "memory",
                            options.trace.string()));
  }
  if (config.run.fidelity == Fidelity::kSampled) {
    throw Error(ExitCode::kUsage,
                fmt::format("{}: a sampled run replays no trace; set another run.fidelity",
                            options.trace.string()));
  }
  check_observation(options.watch, config);
  const std::filesystem::path scene = scene_file(options, metadata);
  ResultFolder folder(options.out.empty() ? "result/replay" : options.out);
  folder.spare(options.trace);
  FrameJob job{config, scene, metadata.scene_name, false, options.quiet, {}};
  job.trees = tree_folder(options.cache);
  job.guest = [&](const PreparedScene& prepared, Frame& /*frame*/) {
    return std::make_unique<RayReplay>(reader, config, prepared, scene);
  };
  Observation observation(options.watch, folder);
  job.observers = observation.observers();
  const int status = run_frame(job, folder);
  observation.tell();
  return status;
}

}  // namespace

void declare_replay_command(CLI::App& app, ReplayOptions& options) {
  using enum ExitCode;
  CLI::App* replay =
      app.add_subcommand("replay", "Run a recorded trace on another machine, without shading");
  declare_trace(*replay, options);
  declare_machine(*replay, options);
  declare_cache(*replay, options);
  replay
      ->add_option("--scene", options.scene,
                   "Rays: the scene it was recorded from, if it is no longer where it was")
      ->type_name("FILE");
  add_choice(*replay, "--mode", kReplayModes, options.mode,
             "Memory: an access waits for those it depends on (elastic, the default), or comes in "
             "its recorded cycle (fixed)");
  declare_observation(*replay, options.watch);
  declare_out(*replay, options, "result/replay");
  replay->add_flag("--quiet", options.quiet, "Print no summary");
  declare_parent(*replay, options);
  replay->footer(
      "What is not set is as it was recorded. Ray traces replay on any ray cache, heuristic, "
      "packet size, traversal scheme and memory, and give the counters of a live run; no picture "
      "is made. Memory traces replay on any caches, L2 and DRAM, without the scene. For example:\n"
      "  sheaf replay result/sponza/rays.trace --set ray_cache.heuristic=mdir(96)\n" +
      exit_codes({kBug, kScene, kStuck, kTrace, kInterrupted}));
}

int replay_command(const ReplayOptions& options) {
  if (options.parent) end_with_parent(*options.parent);
  catch_interrupts();
  TraceReader reader(options.trace);
  reader.verify();
  const TraceMetadata metadata = read_metadata(reader);
  if (reader.identity().kind == TraceKind::kRays) return replay_rays(options, reader, metadata);
  if (options.watch.wanted()) {
    throw Error(ExitCode::kUsage,
                fmt::format("{}: the units that made these accesses are not simulated; --timeline "
                            "and --vcd need a trace of rays",
                            options.trace.string()));
  }
  if (options.scene) {
    throw Error(ExitCode::kUsage,
                fmt::format("{}: holds accesses to memory, which need no scene; --scene is for a "
                            "trace of rays",
                            options.trace.string()));
  }
  if (!options.cache.empty()) {
    throw Error(ExitCode::kUsage,
                fmt::format("{}: holds accesses to memory, which need no kd-tree; --cache is for a "
                            "trace of rays",
                            options.trace.string()));
  }
  const auto is_forbidden = [](std::string_view key) { return !shapes_memory_only(key); };
  const Config config =
      replay_config(options, recorded_config(reader, metadata), "accesses", is_forbidden);
  check_observation(options.watch, config);
  return replay_memory(options, config, reader, metadata);
}

}  // namespace sheaf
