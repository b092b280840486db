// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <systemc>

#include "apps/accuracy_command.h"
#include "apps/coefficients_command.h"
#include "apps/curve_command.h"
#include "apps/memory_command.h"
#include "apps/observation.h"
#include "apps/replay_command.h"
#include "apps/run_command.h"
#include "apps/stability_command.h"
#include "apps/trace_command.h"
#include "base/errors.h"
#include "base/out_of_memory.h"
#include "config/config_text.h"
#include "energy/energy_report.h"
#include "stats/counter_group.h"
#include "system/report_parts.h"

namespace {

constexpr const char* kFooter =
    "Exit codes: 0 done; 1 bug of the simulator; 2 command line or configuration refused;\n"
    "3 scene refused; 4 result not written; 5 machine stuck; 6 trace refused;\n"
    "130 interrupted (partial result).";

struct Commands {
  sheaf::RunOptions run;
  sheaf::MemoryOptions memory;
  sheaf::AccuracyOptions accuracy;
  sheaf::ReplayOptions replay;
  sheaf::TraceOptions trace;
  sheaf::CurveOptions curve;
  sheaf::StabilityOptions stability;
  std::string info_scene;
  bool schema = false;
  bool resolve = false;
  sheaf::RunOptions resolved;
};

template <typename Options>
void declare_machine(CLI::App& command, Options& options) {
  command.add_option("--config", options.config, "TOML file with parameters of the machine");
  command
      .add_option("--set", options.settings,
                  "Set one parameter, for example --set ray_cache.heuristic=mdir(96); repeatable")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

template <typename Options>
void declare_cache(CLI::App& command, Options& options) {
  command
      .add_option("--cache", options.cache,
                  "Folder in which kd-trees are kept from run to run, or none (default sheaf in "
                  "$XDG_CACHE_HOME or ~/.cache; at most 1 GiB)")
      ->type_name("DIR");
}

template <typename Options>
void declare_parent(CLI::App& command, Options& options) {
  command.add_option("--parent", options.parent,
                     "End with the process of this number, which must have started this one");
}

void declare_replay(CLI::App& app, sheaf::ReplayOptions& options) {
  CLI::App* replay =
      app.add_subcommand("replay", "Run a recorded trace on another machine, without shading");
  replay->add_option("TRACE", options.trace, "Trace that 'sheaf run --record' wrote")->required();
  declare_machine(*replay, options);
  declare_cache(*replay, options);
  replay->add_option("--scene", options.scene,
                     "Rays: the scene it was recorded from, if it is no longer where it was");
  replay
      ->add_option("--mode", options.mode,
                   "Memory: elastic (an access waits for those it depends on) or fixed (it comes "
                   "in its recorded cycle)")
      ->capture_default_str()
      ->check(CLI::IsMember({"elastic", "fixed"}));
  sheaf::declare_observation(*replay, options.watch);
  replay->add_option("--out", options.out, "Folder for the results (default result/replay)");
  replay->add_flag("--quiet", options.quiet, "Print no summary");
  declare_parent(*replay, options);
  replay->footer(
      std::string(
          "What is not set is as it was recorded. Ray traces replay on any ray cache, heuristic, "
          "packet\n"
          "size, traversal scheme and memory, and give the counters of a live run; no picture is "
          "made.\n"
          "Memory traces replay on any caches, L2 and DRAM, without the scene.\n"
          "Example: sheaf replay result/sponza/rays.trace --set ray_cache.heuristic=mdir(96)\n\n") +
      kFooter);
}

void declare(CLI::App& app, Commands& commands) {
  app.require_subcommand(1);
  app.footer(kFooter);
  app.set_version_flag("--version", "sheaf " SHEAF_VERSION);

  CLI::App* run = app.add_subcommand("run", "Simulate one frame of a scene on one machine");
  run->add_option("SCENE", commands.run.scene, "glTF 2.0 file (.gltf or .glb)")->required();
  declare_machine(*run, commands.run);
  declare_cache(*run, commands.run);
  run->add_option("--record", commands.run.record,
                  "Also write a trace into the folder: rays (rays.trace) or memory (memory.trace)")
      ->type_name("KIND")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(CLI::IsMember({"rays", "memory"}));
  sheaf::declare_observation(*run, commands.run.watch);
  run->add_option("--out", commands.run.out, "Folder for the results (default result/SCENE)");
  run->add_flag("--no-images", commands.run.no_images,
                "Write no pictures: no image.png, image.exr or heat maps");
  run->add_flag("--quiet", commands.run.quiet, "Print no summary");
  declare_parent(*run, commands.run);
  run->footer(kFooter);

  sheaf::declare_memory_command(app, commands.memory);
  sheaf::declare_accuracy_command(app, commands.accuracy);
  declare_replay(app, commands.replay);
  sheaf::declare_trace_command(app, commands.trace);
  sheaf::declare_curve_command(app, commands.curve);
  sheaf::declare_stability_command(app, commands.stability);

  CLI::App* info = app.add_subcommand("info", "Tell what a scene holds and needs");
  info->add_option("SCENE", commands.info_scene, "glTF 2.0 file (.gltf or .glb)")->required();

  CLI::App* config = app.add_subcommand("config", "Print every parameter with default and meaning");
  CLI::Option* schema =
      config->add_flag("--schema", commands.schema, "Print a JSON schema instead");
  CLI::Option* resolve =
      config->add_flag("--resolve", commands.resolve,
                       "Print the configuration that --config and --set make instead");
  resolve->excludes(schema);
  declare_machine(*config, commands.resolved);
  for (const char* setting : {"--config", "--set"}) config->get_option(setting)->needs(resolve);
  app.add_subcommand("counters", "Print every counter with unit and meaning");
  sheaf::declare_coefficients_command(app);
}

std::string config_output(const Commands& commands) {
  if (commands.schema) return sheaf::config_schema();
  if (commands.resolve) return sheaf::resolved_config(commands.resolved);
  return sheaf::describe_parameters();
}

std::string counters_output() {
  const std::span<const sheaf::CounterGroup> counted = sheaf::counter_groups();
  std::vector<sheaf::CounterGroup> groups(counted.begin(), counted.end());
  const std::vector<sheaf::CounterGroup> energy = sheaf::energy_groups();
  groups.insert(groups.end(), energy.begin(), energy.end());
  return sheaf::print_counters(groups);
}

int dispatch(const CLI::App& app, const Commands& commands) {
  if (app.got_subcommand("run")) return sheaf::run_command(commands.run);
  if (app.got_subcommand("accuracy")) return sheaf::accuracy_command(commands.accuracy);
  if (app.got_subcommand("memory")) return sheaf::memory_command(commands.memory);
  if (app.got_subcommand("replay")) return sheaf::replay_command(commands.replay);
  if (app.got_subcommand("trace")) return sheaf::trace_command(commands.trace);
  if (app.got_subcommand("curve")) return sheaf::curve_command(commands.curve);
  if (app.got_subcommand("stability")) return sheaf::stability_command(commands.stability);
  if (app.got_subcommand("info")) return sheaf::info_command(commands.info_scene);
  if (app.got_subcommand("coefficients")) return sheaf::coefficients_command();
  std::fputs(
      app.got_subcommand("config") ? config_output(commands).c_str() : counters_output().c_str(),
      stdout);
  return 0;
}

int report_error(sheaf::ExitCode code, const char* what) {
  std::fputs(fmt::format("sheaf: {}\n", what).c_str(), stderr);
  return static_cast<int>(code);
}

}  // namespace

// SystemC's library brings a main() that prints its banner; this one does not.
int main(int argc, char** argv) {
  // A limit on file sizes then shows as a write that fails, like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  return sc_core::sc_elab_and_sim(argc, argv);
}

int sc_main(int argc, char** argv) {
  sc_core::sc_report_handler::set_actions("/IEEE_Std_1666/deprecated", sc_core::SC_DO_NOTHING);
  sc_core::sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
  CLI::App app("Sheaf: a cycle-approximate simulator of ray-cache hardware", "sheaf");
  Commands commands;
  declare(app, commands);
  try {
    app.parse(argc, argv);
    return dispatch(app, commands);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? 0 : static_cast<int>(sheaf::ExitCode::kUsage);
  } catch (const sheaf::Error& error) {
    return report_error(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return report_error(sheaf::ExitCode::kUsage, sheaf::kOutOfMemory);
  } catch (const std::exception& error) {
    return report_error(
        sheaf::ExitCode::kBug,
        fmt::format("bug of the simulator, please report it: {}", error.what()).c_str());
  }
}
