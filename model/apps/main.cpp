// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <systemc>

#include "apps/accuracy_command.h"
#include "apps/coefficients_command.h"
#include "apps/curve_command.h"
#include "apps/exit_codes.h"
#include "apps/help_formatter.h"
#include "apps/memory_command.h"
#include "apps/replay_command.h"
#include "apps/run_command.h"
#include "apps/shared_options.h"
#include "apps/stability_command.h"
#include "apps/trace_command.h"
#include "apps/usage_problem.h"
#include "base/errors.h"
#include "base/out_of_memory.h"
#include "base/text.h"
#include "config/config_text.h"
#include "energy/energy_report.h"
#include "stats/counter_group.h"
#include "system/report_parts.h"

namespace {

struct Commands {
  sheaf::RunOptions run;
  sheaf::MemoryOptions memory;
  sheaf::AccuracyOptions accuracy;
  sheaf::ReplayOptions replay;
  sheaf::TraceOptions trace;
  sheaf::CurveOptions curve;
  sheaf::StabilityOptions stability;
  sheaf::InfoOptions info;
  bool schema = false;
  bool resolve = false;
  sheaf::RunOptions resolved;
};

void declare_listings(CLI::App& app, Commands& commands) {
  CLI::App* config = app.add_subcommand("config", "Print every parameter with default and meaning");
  CLI::Option* schema =
      config->add_flag("--schema", commands.schema, "Print a JSON schema instead");
  CLI::Option* resolve =
      config->add_flag("--resolve", commands.resolve,
                       "Print the configuration that --config and --set make instead");
  resolve->excludes(schema);
  sheaf::declare_machine(*config, commands.resolved);
  for (const char* setting : {"--config", "--set"}) config->get_option(setting)->needs(resolve);
  config->footer(sheaf::exit_codes());
  app.add_subcommand("counters", "Print every counter with unit and meaning")
      ->footer(sheaf::exit_codes());
  sheaf::declare_coefficients_command(app);
}

void declare(CLI::App& app, Commands& commands) {
  using enum sheaf::ExitCode;
  app.formatter(std::make_shared<sheaf::HelpFormatter>());
  app.require_subcommand(1);
  app.footer(sheaf::exit_codes({kBug, kScene, kStuck, kTrace, kInterrupted}));
  app.set_version_flag("--version", "sheaf " SHEAF_VERSION);
  sheaf::declare_run_command(app, commands.run);
  sheaf::declare_memory_command(app, commands.memory);
  sheaf::declare_accuracy_command(app, commands.accuracy);
  sheaf::declare_replay_command(app, commands.replay);
  sheaf::declare_trace_command(app, commands.trace);
  sheaf::declare_curve_command(app, commands.curve);
  sheaf::declare_stability_command(app, commands.stability);
  sheaf::declare_info_command(app, commands.info);
  declare_listings(app, commands);
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
  if (app.got_subcommand("info")) return sheaf::info_command(commands.info);
  if (app.got_subcommand("coefficients")) return sheaf::coefficients_command();
  std::fputs(
      app.got_subcommand("config") ? config_output(commands).c_str() : counters_output().c_str(),
      stdout);
  return 0;
}

int perform(CLI::App& app, const Commands& commands, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    throw sheaf::Error(sheaf::ExitCode::kUsage, sheaf::usage_problem(app, error));
  }
  return dispatch(app, commands);
}

// What is printed is a result like others: a full disk may only show here.
void finish_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw sheaf::Error(sheaf::ExitCode::kOutput,
                     "standard output: cannot be written; is the disk full?");
}

// One line, whatever the names of files hold.
int report_error(sheaf::ExitCode code, const std::string& what) {
  std::fputs(fmt::format("sheaf: {}\n", sheaf::printable(what, what.size())).c_str(), stderr);
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
    const int status = perform(app, commands, argc, argv);
    finish_output();
    return status;
  } catch (const sheaf::Error& error) {
    return report_error(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return report_error(sheaf::ExitCode::kUsage, sheaf::kOutOfMemory);
  } catch (const std::exception& error) {
    return report_error(sheaf::ExitCode::kBug,
                        fmt::format("bug of the simulator, please report it: {}", error.what()));
  }
}
