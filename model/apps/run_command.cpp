// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/run_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <tuple>

#include "apps/exit_codes.h"
#include "apps/frame_run.h"
#include "apps/observation.h"
#include "apps/parent_death.h"
#include "apps/recording.h"
#include "apps/shared_options.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "config/config_text.h"
#include "config/read_config.h"
#include "scene/load_gltf.h"
#include "scene/scene_info.h"
#include "sorting/heuristic.h"

namespace sheaf {
namespace {

std::filesystem::path output_folder(const RunOptions& options) {
  if (!options.out.empty()) return options.out;
  return std::filesystem::path("result") / options.scene.stem();
}

}  // namespace

void declare_run_command(CLI::App& app, RunOptions& options) {
  using enum ExitCode;
  CLI::App* run = app.add_subcommand("run", "Simulate one frame of a scene on one machine");
  declare_scene(*run, options);
  declare_machine(*run, options);
  declare_cache(*run, options);
  run->add_option("--record", options.record,
                  "Also write a trace into the folder: rays.trace or memory.trace; repeatable")
      ->type_name("")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(CLI::IsMember({"rays", "memory"}));
  declare_observation(*run, options.watch);
  declare_out(*run, options, "result/SCENE");
  run->add_flag("--no-images", options.no_images,
                "Write no pictures: no image.png, image.exr or heat maps");
  run->add_flag("--quiet", options.quiet, "Print no summary");
  declare_parent(*run, options);
  run->footer(exit_codes({kBug, kScene, kStuck, kInterrupted}));
}

int run_command(const RunOptions& options) {
  if (options.parent) end_with_parent(*options.parent);
  const Config config = resolve_config(options.config, options.settings);
  // Refused before the scene is loaded.
  static_cast<void>(HeuristicChoice::parse(config.ray_cache.heuristic));
  check_recording(options.record, config);
  check_observation(options.watch, config);
  catch_interrupts();
  ResultFolder folder(output_folder(options));
  FrameJob job{
      config, options.scene, options.scene.filename().string(), !options.no_images, options.quiet,
      {}};
  job.trees = tree_folder(options.cache);
  Observation observation(options.watch, folder);
  job.observers = observation.observers();
  if (!options.record.empty()) {
    job.guest = [&](const PreparedScene& scene, Frame& frame) {
      return std::make_unique<Recording>(options, config, scene, frame, folder);
    };
  }
  const int status = run_frame(job, folder);
  observation.tell();
  return status;
}

std::string resolved_config(const RunOptions& options) {
  const Config config = resolve_config(options.config, options.settings);
  std::ignore = HeuristicChoice::parse(config.ray_cache.heuristic);
  return config_toml(config, Comments::kMeanings);
}

void declare_info_command(CLI::App& app, InfoOptions& options) {
  CLI::App* info = app.add_subcommand("info", "Tell what a scene holds and needs");
  declare_scene(*info, options);
  info->footer(exit_codes({ExitCode::kScene}));
}

int info_command(const InfoOptions& options) {
  const LoadedScene loaded = load_scene(options.scene);
  for (const std::string& warning : loaded.warnings) {
    std::fputs(fmt::format("sheaf: note: {}\n", warning).c_str(), stderr);
  }
  std::fputs(scene_info(loaded).c_str(), stdout);
  return static_cast<int>(ExitCode::kOk);
}

}  // namespace sheaf
