// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/accuracy_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/accuracy/output.h"
#include "apps/exit_codes.h"
#include "apps/frame_run.h"
#include "apps/shared_options.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "config/config_text.h"
#include "config/read_config.h"
#include "report/result_folder.h"

namespace sheaf {
namespace {

// With --reference timed the dearest level is left out.
std::vector<Level> chosen_levels(const std::string& reference) {
  std::vector<Level> chosen;
  for (const Level& level : levels()) {
    chosen.push_back(level);
    if (level.name == reference) break;
  }
  return chosen;
}

Config config_of(const AccuracyOptions& options, const Level& level) {
  std::vector<std::string> settings = options.settings;
  settings.insert(settings.end(), level.settings.begin(), level.settings.end());
  return resolve_config(options.config, settings);
}

// The reference first: without it nothing can be said.
bool run_levels(const AccuracyOptions& options, const PreparedScene& scene,
                AccuracyResult& result) {
  std::vector<Level> chosen = chosen_levels(options.reference);
  const Level reference = chosen.back();
  chosen.pop_back();
  const std::optional<LevelRun> best =
      run_level(reference, config_of(options, reference), scene, interrupted);
  if (!best) return false;
  result.reference = *best;
  bool complete = true;
  for (const Level& level : chosen) {
    const auto run = run_level(level, config_of(options, level), scene, interrupted);
    complete = run.has_value();
    if (!complete) break;
    result.runs.push_back(*run);
  }
  result.runs.push_back(*best);
  return complete;
}

void write_plot(const Plot& plot, const std::string& name, ResultFolder& folder) {
  const auto write = [&](const std::string& extension, const std::vector<std::uint8_t>& bytes) {
    folder.write(name + extension, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  };
  write(".svg", plot_svg(plot));
  write(".png", plot_png(plot));
}

void write_result(const AccuracyResult& result, const Config& config, const std::string& text,
                  ResultFolder& folder) {
  folder.write("config.toml", config_toml(config, Comments::kMeanings));
  folder.write("accuracy.txt", text);
  folder.write("accuracy.csv", accuracy_csv(result));
  write_plot(accuracy_plot(result), "accuracy", folder);
  if (!result.images.empty()) {
    folder.write("image_error.csv", image_error_csv(result));
    write_plot(image_error_plot(result), "image_error", folder);
  }
  if (!result.precision.rows.empty()) {
    folder.write("precision.csv", precision_csv(result.precision));
  }
  folder.commit();
}

}  // namespace

void declare_accuracy_command(CLI::App& app, AccuracyOptions& options) {
  CLI::App* command = app.add_subcommand(
      "accuracy",
      "Compare levels of fidelity, film formats and bits of planes and rays by cost and error");
  declare_scene(*command, options);
  declare_machine(*command, options);
  command
      ->add_option("--reference", options.reference,
                   "What errors are measured against: clocked (default) or timed")
      ->type_name("")
      ->check(CLI::IsMember({"clocked", "timed"}));
  declare_out(*command, options, "result/accuracy");
  declare_cache(*command, options);
  using enum ExitCode;
  command->footer(
      "Leaves accuracy.txt, accuracy.csv and image_error.csv with a plot of each, and "
      "precision.csv. Every level runs in a process of its own on the same prepared scene; "
      "run.fidelity, run.quantum, run.sample_share and film.format are chosen by this command. The "
      "reference clocked is exact and slow; timed is usually the same. Interrupted, it writes "
      "nothing but whole levels. For example:\n"
      "  sheaf accuracy scenes/dragon.glb --set image.width=160 --set image.height=120\n" +
      exit_codes({kBug, kScene, kStuck, kInterrupted}));
}

int accuracy_command(const AccuracyOptions& options) {
  const Config config = resolve_config(options.config, options.settings);
  catch_interrupts();
  ResultFolder folder(options.out.empty() ? "result/accuracy" : options.out);
  PreparedScene scene = prepare_scene(options.scene, config, tree_folder(options.cache));
  AccuracyResult result;
  result.scene = options.scene.filename().string();
  const bool complete = run_levels(options, scene, result);
  if (complete) result.images = image_errors(config, scene, interrupted);
  if (complete) result.precision = precision_costs(config, scene, interrupted);
  if (result.runs.empty()) {
    throw Error(ExitCode::kInterrupted, "stopped before a level was complete; nothing is written");
  }
  std::string text = accuracy_text(result);
  if (interrupted()) text = "PARTIAL: interrupted\n" + text;
  write_result(result, config, text, folder);
  std::fputs(text.c_str(), stdout);
  std::fputs(fmt::format("Results: {}\n", folder.path().string()).c_str(), stdout);
  return static_cast<int>(interrupted() ? ExitCode::kInterrupted : ExitCode::kOk);
}

}  // namespace sheaf
