// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/frame_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "apps/simulate_frame.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "config/config_text.h"
#include "energy/energy_report.h"
#include "report/images.h"
#include "report/stats_json.h"
#include "report/summary.h"
#include "scene/load_gltf.h"
#include "system/coherence.h"
#include "system/report_parts.h"
#include "system/reported_values.h"

namespace sheaf {
namespace {

Vec3 to_vec(const Triple& t) {
  return {static_cast<float>(t.x), static_cast<float>(t.y), static_cast<float>(t.z)};
}

template <typename To, typename From, typename F>
std::optional<To> convert(const std::optional<From>& value, F&& f) {
  return value ? std::optional<To>(f(*value)) : std::nullopt;
}

SceneLoadOptions load_options(const Config& config) {
  const auto to_float = [](double x) { return static_cast<float>(x); };
  SceneLoadOptions options;
  options.reflectance = convert<float>(config.scene.reflectance, to_float);
  options.background = to_vec(config.scene.background);
  options.camera_name = config.camera.name;
  options.camera_position = convert<Vec3>(config.camera.position, to_vec);
  options.camera_look_at = convert<Vec3>(config.camera.look_at, to_vec);
  options.camera_yfov = convert<float>(config.camera.yfov, to_float);
  options.light_position = convert<Vec3>(config.light.position, to_vec);
  options.light_intensity = convert<float>(config.light.intensity, to_float);
  return options;
}

Scene load_with_notes(const std::filesystem::path& file, const Config& config) {
  LoadedScene loaded = load_scene(file, load_options(config));
  for (const std::string& warning : loaded.warnings) {
    std::fputs(fmt::format("sheaf: note: {}\n", warning).c_str(), stderr);
  }
  return std::move(loaded.scene);
}

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::optional<std::filesystem::path> tree_folder(const std::string& option) {
  if (option.empty()) return TreeCache::default_folder();
  if (option == "none") return {};
  return option;
}

PreparedScene prepare_scene(const std::filesystem::path& file, const Config& config,
                            const std::optional<std::filesystem::path>& trees) {
  std::optional<TreeCache> cache;
  if (trees) cache.emplace(*trees);
  return {load_with_notes(file, config), config, cache ? &*cache : nullptr};
}

int finish_run(const RunResult& result, ResultFolder& folder) {
  folder.write("config.toml", config_toml(result.config, Comments::kMeanings));
  folder.write("summary.txt", result.summary);
  folder.write("stats.json", stats_json(result.stats));
  folder.commit();
  if (!result.quiet) {
    std::fputs(result.summary.c_str(), stdout);
    std::fputs(fmt::format("Results: {}\n", folder.path().string()).c_str(), stdout);
  }
  if (result.complete) return static_cast<int>(ExitCode::kOk);
  std::fputs(
      fmt::format("sheaf: stopped before {}; the results are marked as partial\n", result.unreached)
          .c_str(),
      stderr);
  return static_cast<int>(interrupted() ? ExitCode::kInterrupted : ExitCode::kOk);
}

int run_frame(const FrameJob& job, ResultFolder& folder) {
  const Config& config = job.config;
  const HeuristicChoice heuristic = HeuristicChoice::parse(config.ray_cache.heuristic);
  const Stopwatch load_watch;
  Scene loaded = load_with_notes(job.scene, config);
  const double load_seconds = load_watch.seconds();
  const BuildPlan plan = plan_machine(config, loaded.needs);
  const Stopwatch build_watch;
  std::optional<TreeCache> trees;
  if (job.trees) trees.emplace(*job.trees);
  const PreparedScene scene(std::move(loaded), config, trees ? &*trees : nullptr);
  const double build_seconds = build_watch.seconds();

  Frame frame(config);
  StatsTree stats;
  stats.add_text("run", RunValues::scene, job.scene_name);
  stats.add_text("run", RunValues::config_hash, config_hash(config));
  stats.add_text("run", RunValues::heuristic, heuristic.to_string());
  report_scene(scene, plan, stats);
  const std::unique_ptr<FrameGuest> guest = job.guest ? job.guest(scene, frame) : nullptr;
  const Stopwatch run_watch;
  const RunHooks hooks = guest ? guest->hooks() : RunHooks{};
  const auto stop = [&] { return interrupted() || (guest && guest->failed()); };
  bool complete = simulate_frame({config, plan, scene, hooks, job.observers, stop}, frame, stats);
  const double run_seconds = run_watch.seconds();
  report_rays(frame.rays, stats);
  report_energy(config, plan, stats);
  const bool traced = complete;
  if (config.measure.coherence && traced) {
    CoherencePass coherence(config, scene);
    complete = coherence.run(interrupted);
    if (complete) coherence.report(plan.secondary_rays, stats);
  }
  stats.add("run", RunValues::complete, complete ? 1 : 0);
  if (guest) guest->finish(traced, stats);

  const std::string summary =
      summarize({config, plan, stats, complete, {load_seconds, build_seconds, run_seconds}});
  if (job.images) write_images(config, frame, folder);
  const char* const unreached = traced ? "coherence had been measured" : "the frame was complete";
  return finish_run({config, stats, summary, complete, unreached, job.quiet}, folder);
}

}  // namespace sheaf
