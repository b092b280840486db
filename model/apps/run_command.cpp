// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/run_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <tuple>

#include "apps/frame_run.h"
#include "apps/observation.h"
#include "apps/parent_death.h"
#include "apps/recording.h"
#include "base/errors.h"
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

int info_command(const std::filesystem::path& scene) {
  const LoadedScene loaded = load_scene(scene);
  for (const std::string& warning : loaded.warnings) {
    std::fputs(fmt::format("sheaf: note: {}\n", warning).c_str(), stderr);
  }
  std::fputs(scene_info(loaded).c_str(), stdout);
  return static_cast<int>(ExitCode::kOk);
}

}  // namespace sheaf
