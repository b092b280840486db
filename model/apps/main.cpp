// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <systemc>

#include "apps/memory_command.h"
#include "apps/run_command.h"
#include "base/errors.h"
#include "config/config_text.h"
#include "stats/counter_group.h"
#include "system/report_parts.h"

namespace {

constexpr const char* kFooter =
    "Exit codes: 0 done; 1 bug of the simulator; 2 command line or configuration refused;\n"
    "3 scene refused; 4 result not written; 5 machine stuck; 130 interrupted (partial result).";

struct Commands {
  sheaf::RunOptions run;
  sheaf::MemoryOptions memory;
  std::string info_scene;
  bool schema = false;
};

void declare(CLI::App& app, Commands& commands) {
  app.require_subcommand(1);
  app.footer(kFooter);
  app.set_version_flag("--version", "sheaf " SHEAF_VERSION);

  CLI::App* run = app.add_subcommand("run", "Simulate one frame of a scene on one machine");
  run->add_option("SCENE", commands.run.scene, "glTF 2.0 file (.gltf or .glb)")->required();
  run->add_option("--config", commands.run.config, "TOML file with parameters of the machine");
  run->add_option("--set", commands.run.settings,
                  "Set one parameter, for example --set ray_cache.heuristic=mdir(96); repeatable")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  run->add_option("--out", commands.run.out, "Folder for the results (default result/SCENE)");
  run->add_flag("--quiet", commands.run.quiet, "Print no summary");
  run->footer(kFooter);

  sheaf::declare_memory_command(app, commands.memory);

  CLI::App* info = app.add_subcommand("info", "Tell what a scene holds and needs");
  info->add_option("SCENE", commands.info_scene, "glTF 2.0 file (.gltf or .glb)")->required();

  CLI::App* config = app.add_subcommand("config", "Print every parameter with default and meaning");
  config->add_flag("--schema", commands.schema, "Print a JSON schema instead");
  app.add_subcommand("counters", "Print every counter with unit and meaning");
}

int dispatch(const CLI::App& app, const Commands& commands) {
  if (app.got_subcommand("run")) return sheaf::run_command(commands.run);
  if (app.got_subcommand("memory")) return sheaf::memory_command(commands.memory);
  if (app.got_subcommand("info")) return sheaf::info_command(commands.info_scene);
  if (app.got_subcommand("config")) {
    const std::string text =
        commands.schema ? sheaf::config_schema() : sheaf::describe_parameters();
    std::fputs(text.c_str(), stdout);
  } else {
    std::fputs(sheaf::print_counters(sheaf::counter_groups()).c_str(), stdout);
  }
  return 0;
}

int report_error(sheaf::ExitCode code, const char* what) {
  std::fputs(fmt::format("sheaf: {}\n", what).c_str(), stderr);
  return static_cast<int>(code);
}

}  // namespace

// SystemC's library brings a main() that prints its banner; this one does not.
int main(int argc, char** argv) {
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
    return report_error(sheaf::ExitCode::kUsage,
                        "out of memory; choose a smaller picture or scene");
  } catch (const std::exception& error) {
    return report_error(
        sheaf::ExitCode::kBug,
        fmt::format("bug of the simulator, please report it: {}", error.what()).c_str());
  }
}
