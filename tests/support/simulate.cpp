// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "support/simulate.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <systemc>
#include <tuple>

#include "config/read_config.h"
#include "report/stats_json.h"
#include "scene/load_gltf.h"
#include "scene/scene_needs.h"
#include "system/clocked_machine.h"
#include "system/estimate_report.h"
#include "system/functional_pipeline.h"
#include "system/machine.h"
#include "system/report_parts.h"
#include "system/sampled_frame.h"

namespace sheaf::test {
namespace {

// A run that takes longer hangs: the slowest takes seconds.
constexpr unsigned kSecondsToHang = 300;

PreparedScene prepare(const std::filesystem::path& file, const Config& config) {
  SceneLoadOptions options;
  const Triple& background = config.scene.background;
  options.background = {static_cast<float>(background.x), static_cast<float>(background.y),
                        static_cast<float>(background.z)};
  if (config.scene.reflectance) {
    options.reflectance = static_cast<float>(*config.scene.reflectance);
  }
  return {load_scene(file, options).scene, config};
}

Scene with_needs(Scene scene) {
  scene.needs = make_needs(scene);
  return scene;
}

std::string systemc_complaints;

void keep_complaints(const sc_core::sc_report& report, const sc_core::sc_actions& actions) {
  if (report.get_severity() != sc_core::SC_INFO) {
    systemc_complaints += fmt::format("SystemC: {}; ", report.get_msg());
  }
  if (report.get_severity() >= sc_core::SC_ERROR) {
    sc_core::sc_report_handler::default_handler(report, actions);
  }
}

bool simulate_analytic(const Config& config, const BuildPlan& plan, const PreparedScene& scene,
                       Frame& frame, StatsTree& stats) {
  AnalyticModel model(config, scene);
  FunctionalPipeline pipeline(config, plan, scene, frame, {}, &model);
  const bool complete = model.run(pipeline, {});
  pipeline.report(stats);
  report_analytic(model, config, stats);
  return complete;
}

template <typename Simulator>
bool simulate(const Config& config, const BuildPlan& plan, const PreparedScene& scene, Frame& frame,
              bool in_step, StatsTree& stats) {
  Simulator simulator(config, plan, scene, frame);
  if constexpr (std::is_same_v<Simulator, Machine>) {
    if (in_step) simulator.clock_domain().forbid_running_ahead();
  }
  const bool complete = simulator.run({});
  simulator.report(stats);
  return complete;
}

Outcome run_here(const Config& config, const PreparedScene& scene, bool in_step) {
  Outcome outcome;
  sc_core::sc_report_handler::set_handler(keep_complaints);
  try {
    const BuildPlan plan = plan_machine(config, scene.scene.needs);
    Frame frame(config);
    StatsTree stats;
    const auto simulate_as = [&]<typename Simulator>() {
      return simulate<Simulator>(config, plan, scene, frame, in_step, stats);
    };
    if (config.run.fidelity == Fidelity::kFunctional) {
      outcome.complete = simulate_as.template operator()<FunctionalPipeline>();
    } else if (config.run.fidelity == Fidelity::kAnalytic) {
      outcome.complete = simulate_analytic(config, plan, scene, frame, stats);
    } else if (config.run.fidelity == Fidelity::kSampled) {
      outcome.complete = simulate_as.template operator()<SampledFrame>();
    } else if (config.run.fidelity == Fidelity::kClocked) {
      outcome.complete = simulate_as.template operator()<ClockedMachine>();
    } else {
      outcome.complete = simulate_as.template operator()<Machine>();
    }
    report_rays(frame.rays, stats);
    outcome.stats = nlohmann::json::parse(stats_json(stats));
    for (std::uint32_t i = 0; i < config.image.width * config.image.height; ++i) {
      outcome.image.push_back(frame.film->value(i));
    }
  } catch (const std::exception& error) {
    outcome.error = error.what();
  }
  outcome.error = systemc_complaints + outcome.error;
  return outcome;
}

// Parent and child share an open file, through which the outcome comes back.

void write_text(std::FILE* file, const std::string& text) {
  const std::uint64_t size = text.size();
  std::fwrite(&size, sizeof size, 1, file);
  std::fwrite(text.data(), 1, text.size(), file);
}

std::string read_text(std::FILE* file) {
  std::uint64_t size = 0;
  if (std::fread(&size, sizeof size, 1, file) != 1) throw std::runtime_error("a run said nothing");
  std::string text(size, '\0');
  if (std::fread(text.data(), 1, size, file) != size) throw std::runtime_error("a run broke off");
  return text;
}

void send(std::FILE* file, const Outcome& outcome) {
  write_text(file, outcome.error);
  write_text(file, outcome.complete ? "complete" : "partial");
  write_text(file, outcome.stats.dump());
  write_text(file, {reinterpret_cast<const char*>(outcome.image.data()),
                    outcome.image.size() * sizeof(Vec3)});
}

Outcome receive(std::FILE* file) {
  Outcome outcome;
  outcome.error = read_text(file);
  outcome.complete = read_text(file) == "complete";
  outcome.stats = nlohmann::json::parse(read_text(file));
  const std::string pixels = read_text(file);
  const auto* const first = reinterpret_cast<const Vec3*>(pixels.data());
  outcome.image.assign(first, first + pixels.size() / sizeof(Vec3));
  return outcome;
}

/// Throws if `config` needs another PreparedScene than `base`.
void check_same_scene(const Config& base, const Config& config) {
  const auto tree = [](const KdTreeSpec& spec) {
    return std::tuple(spec.traversal_cost, spec.intersection_cost, spec.empty_bonus,
                      spec.max_depth);
  };
  if (base.image.width != config.image.width || base.image.height != config.image.height ||
      base.film.format != config.film.format || tree(base.kdtree) != tree(config.kdtree) ||
      base.scene.reflectance != config.scene.reflectance ||
      base.scene.background != config.scene.background) {
    throw std::logic_error("TestScene: set this in the base settings");
  }
}

}  // namespace

std::uint64_t Outcome::count(const std::string& path) const {
  return stats.at(path).at("value").get<std::uint64_t>();
}

nlohmann::json Outcome::entries(const std::vector<std::string>& prefixes) const {
  nlohmann::json found = nlohmann::json::object();
  for (const auto& [path, entry] : stats.items()) {
    for (const std::string& prefix : prefixes) {
      if (path.starts_with(prefix)) found[path] = entry;
    }
  }
  return found;
}

TestScene::TestScene(const std::filesystem::path& file, Settings base)
    : base_(std::move(base)),
      config_(resolve_config({}, base_)),
      prepared_(prepare(file, config_)) {}

TestScene::TestScene(Scene scene, Settings base)
    : base_(std::move(base)),
      config_(resolve_config({}, base_)),
      prepared_(with_needs(std::move(scene)), config_) {}

Outcome TestScene::run(const Settings& settings) const {
  Settings all = base_;
  all.insert(all.end(), settings.begin(), settings.end());
  return run(resolve_config({}, all));
}

Outcome TestScene::run_in_step(const Settings& settings) const {
  Settings all = base_;
  all.insert(all.end(), settings.begin(), settings.end());
  return run(resolve_config({}, all), true);
}

Outcome TestScene::run(const Config& config) const {
  return run(config, false);
}

Outcome TestScene::run(const Config& config, bool in_step) const {
  check_same_scene(config_, config);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
  if (file == nullptr) throw std::runtime_error("no temporary file");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    alarm(kSecondsToHang);
    send(file.get(), run_here(config, prepared_, in_step));
    std::fflush(file.get());
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status)) {
    Outcome outcome;
    outcome.error = fmt::format("ended by signal {}", WTERMSIG(status));
    return outcome;
  }
  std::rewind(file.get());
  return receive(file.get());
}

}  // namespace sheaf::test
