// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/memory_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <utility>

#include "apps/exit_codes.h"
#include "apps/shared_options.h"
#include "base/errors.h"
#include "base/text.h"
#include "config/read_config.h"
#include "memory/dram/trace_run.h"
#include "report/memory_summary.h"
#include "report/progress.h"
#include "report/stats_json.h"

namespace sheaf {
namespace {

constexpr std::array<std::pair<const char*, StreamKind>, 3> kStreams{
    {{"sequential", StreamKind::kSequential},
     {"random", StreamKind::kRandom},
     {"interleaved", StreamKind::kInterleaved}}};

/// A file may describe a whole machine; a setting is there to have an effect.
void check_settings(const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    if (setting.starts_with("dram.")) continue;
    throw Error(ExitCode::kUsage,
                fmt::format("--set {}: there is nothing here but the memory; set dram.*, or "
                            "simulate the machine with sheaf run",
                            printable(setting)));
  }
}

DramDevice device_of(const MemoryOptions& options) {
  DramSpec dram = resolve_config(options.config, options.settings).dram;
  check_settings(options.settings);
  if (dram.model == DramModel::kFixed) dram.model = DramModel::kDdr4_2400;
  return resolve_dram(dram);
}

void check_length(const StreamSpec& spec) {
  if (spec.gap == 0 || spec.count - 1 <= kLastArrival / spec.gap) return;
  throw Error(
      ExitCode::kUsage,
      fmt::format("--count {} --gap {}: the last access would arrive later than 2^52 memory "
                  "cycles; choose fewer accesses or a smaller gap",
                  spec.count, spec.gap));
}

// Asks often enough for a smooth line, seldom enough not to be felt.
constexpr std::uint64_t kProgressEvery = 1 << 16;

void run_trace(TextTrace& trace, TraceRun& run) {
  TraceAccess access;
  while (trace.next(access)) run.add(access);
}

void run_stream(const StreamSpec& spec, AccessStream& stream, TraceRun& run) {
  Progress progress;
  TraceAccess access;
  for (std::uint64_t i = 0; stream.next(access); ++i) {
    run.add(access);
    if (i % kProgressEvery == 0) {
      progress.update(static_cast<double>(i) / static_cast<double>(spec.count), "accesses");
    }
  }
}

}  // namespace

void declare_memory_command(CLI::App& app, MemoryOptions& options) {
  CLI::App* memory =
      app.add_subcommand("memory", "Drive the memory alone, from a trace or a made-up stream");
  memory->add_option("TRACE", options.trace, "Memory trace in DRAMsim3's form; - = standard input");
  CLI::Option* generate = add_choice(*memory, "--generate", kStreams, options.generate,
                                     "Make a stream instead; interleaved is over the bank groups");
  const auto of_streams = [&](const char* name, auto& value, const char* meaning) {
    return memory->add_option(name, value, meaning)
        ->type_name("N")
        ->capture_default_str()
        ->needs(generate);
  };
  of_streams("--count", options.count, "Accesses to generate")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40));
  of_streams("--gap", options.gap, "Memory cycles between two generated arrivals")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000}));
  of_streams("--seed", options.seed, "Seed of generated addresses and of which accesses write");
  of_streams("--writes", options.write_share, "Share of generated accesses that write, 0 to 1")
      ->check(CLI::Range(0.0, 1.0));
  memory->add_option("--bytes", options.bytes, "Bytes of every access, 1 to 4096")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{4096}));
  declare_machine(*memory, options);
  memory->add_flag("--json", options.json, "Print every figure as JSON");
  memory->footer(
      "A line of TRACE is an address, a command and an arrival in memory cycles: 0x2000D5C0 READ "
      "30. An arrival that finds its queue full waits, and those behind it wait with it. A latency "
      "runs from the acceptance into the queue to the last byte on the data bus.\n"
      "The memory is dram.model with the other dram.* (sheaf config lists them); DDR4-2400 if that "
      "is fixed, which has no banks to report on. Of a --config, the rest is of no account here. "
      "For example:\n"
      "  sheaf memory --generate random --gap 16\n"
      "  sheaf memory trace.txt --set dram.model=HBM2-2000 --set dram.page=closed --json\n" +
      exit_codes({ExitCode::kTrace}));
}

int memory_command(const MemoryOptions& options) {
  if (options.trace.empty() != options.generate.has_value()) {
    throw Error(ExitCode::kUsage,
                "memory needs either a TRACE or --generate sequential, random or interleaved");
  }
  TraceRun run(device_of(options), options.bytes);
  std::string source = options.trace;
  if (!options.trace.empty()) {
    TextTrace trace(options.trace);
    run_trace(trace, run);
  } else {
    const StreamSpec spec{.kind = *options.generate,
                          .count = options.count,
                          .gap = options.gap,
                          .seed = options.seed,
                          .write_share = options.write_share,
                          .bytes = options.bytes};
    check_length(spec);
    AccessStream stream(spec, run.device());
    run_stream(spec, stream, run);
    source = fmt::format("{} stream, gap {}", name_of(kStreams, *options.generate), options.gap);
  }
  run.finish();
  if (run.result().num_wrapped != 0) {
    std::fputs(
        fmt::format("sheaf: note: {} accesses lie beyond the capacity of the memory and were "
                    "wrapped into it\n",
                    run.result().num_wrapped)
            .c_str(),
        stderr);
  }
  StatsTree stats;
  report_trace_run(run, stats);
  std::fputs((options.json ? stats_json(stats) : summarize_memory(run, source)).c_str(), stdout);
  return static_cast<int>(ExitCode::kOk);
}

}  // namespace sheaf
