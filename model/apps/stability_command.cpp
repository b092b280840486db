// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/stability_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>

#include "base/errors.h"
#include "base/interrupt.h"
#include "report/progress.h"
#include "report/result_folder.h"
#include "stability/report.h"

namespace sheaf {
namespace {

bool selected(const stability::StabilityCase& c, const std::string& only) {
  return (c.group + "/" + c.name).find(only) != std::string::npos;
}

}  // namespace

void declare_stability_command(CLI::App& app, StabilityOptions& options) {
  CLI::App* stability = app.add_subcommand(
      "stability", "Check the simulator's numbers on extreme and stiff cases, with bounds");
  stability->add_flag("--quick", options.quick, "A twentieth of the trials");
  stability
      ->add_option("--only", options.only,
                   "Only cases whose GROUP/NAME contains this, for example leaks/ or needles")
      ->type_name("TEXT");
  stability->add_option("--out", options.out, "Folder for stability.md and stability.csv")
      ->type_name("DIR");
  stability->footer(
      "Exit codes: 0 every case passes; 1 a bound is broken, which is a bug of the simulator;\n"
      "2 command line refused; 4 result not written; 130 interrupted (nothing is written).");
}

int stability_command(const StabilityOptions& options) {
  std::vector<stability::StabilityCase> cases = stability::catalogue();
  std::erase_if(cases, [&](const auto& c) { return !selected(c, options.only); });
  if (cases.empty()) {
    throw Error(
        ExitCode::kUsage,
        fmt::format("--only {}: no case of this name; without it all are run", options.only));
  }
  const stability::Effort effort{options.quick};
  catch_interrupts();
  std::optional<ResultFolder> folder;
  if (!options.out.empty()) folder.emplace(options.out);

  Progress progress;
  std::vector<stability::CaseResult> results;
  std::size_t num_failed = 0;
  for (const auto& c : cases) {
    progress.update(static_cast<double>(results.size()) / static_cast<double>(cases.size()),
                    c.group + ": " + c.name);
    results.push_back({c, c.measure(effort)});
    num_failed += results.back().passes() ? 0 : 1;
    progress.erase();
    if (interrupted()) {
      throw Error(ExitCode::kInterrupted,
                  fmt::format("stopped in {}/{}; nothing is written", c.group, c.name));
    }
    std::fputs(stability::as_text(results.back()).c_str(), stdout);
    std::fflush(stdout);
  }
  if (folder) {
    folder->write("stability.md", stability::as_markdown(results, effort));
    folder->write("stability.csv", stability::as_csv(results));
    folder->commit();
  }
  std::fputs(
      fmt::format("{} of {} cases pass\n", results.size() - num_failed, results.size()).c_str(),
      stdout);
  return static_cast<int>(num_failed == 0 ? ExitCode::kOk : ExitCode::kBug);
}

}  // namespace sheaf
