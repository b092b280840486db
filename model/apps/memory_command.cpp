// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/memory_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "base/errors.h"
#include "config/read_config.h"
#include "memory/dram/stream.h"
#include "memory/dram/trace_run.h"
#include "report/memory_summary.h"
#include "report/progress.h"
#include "report/stats_json.h"

namespace sheaf {
namespace {

constexpr const char* kFooter =
    "A line of TRACE is an address, a command and an arrival in memory cycles: 0x2000D5C0 READ "
    "30.\n"
    "An arrival that finds its queue full waits, and those behind it wait with it. A latency runs\n"
    "from the acceptance into the queue to the last byte on the data bus.\n"
    "The memory is dram.model with the other dram.* (sheaf config lists them); DDR4-2400 if that "
    "is\n"
    "fixed, which has no banks to report on. For example:\n"
    "  sheaf memory --generate random --gap 16\n"
    "  sheaf memory trace.txt --set dram.model=HBM2-2000 --set dram.page=closed --json\n"
    "Exit codes: 0 done; 2 command line, configuration or trace refused.";

StreamKind stream_kind(const std::string& name) {
  if (name == "random") return StreamKind::kRandom;
  return name == "interleaved" ? StreamKind::kInterleaved : StreamKind::kSequential;
}

DramDevice device_of(const MemoryOptions& options) {
  const auto file = options.config ? std::optional<std::filesystem::path>(*options.config)
                                   : std::optional<std::filesystem::path>();
  DramSpec dram = resolve_config(file, options.settings).dram;
  if (dram.model == DramModel::kFixed) dram.model = DramModel::kDdr4_2400;
  return resolve_dram(dram);
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
  memory
      ->add_option("--generate", options.generate,
                   "Make a stream instead: sequential, random or interleaved over bank groups")
      ->check(CLI::IsMember({"sequential", "random", "interleaved"}));
  memory->add_option("--count", options.count, "Accesses to generate")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40));
  memory->add_option("--gap", options.gap, "Memory cycles between two generated arrivals")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000}));
  memory->add_option("--seed", options.seed, "Seed of generated addresses")->capture_default_str();
  memory->add_option("--writes", options.write_share, "Share of generated accesses that write")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  memory->add_option("--bytes", options.bytes, "Bytes of every access")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{4096}));
  memory->add_option("--config", options.config, "TOML file with parameters");
  memory->add_option("--set", options.settings, "Set one parameter; repeatable")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  memory->add_flag("--json", options.json, "Print every figure as JSON");
  memory->footer(kFooter);
}

int memory_command(const MemoryOptions& options) {
  if (options.trace.empty() == options.generate.empty()) {
    throw Error(ExitCode::kUsage,
                "memory needs either a TRACE or --generate sequential, random or interleaved");
  }
  TraceRun run(device_of(options), options.bytes);
  std::string source = options.trace;
  if (!options.trace.empty()) {
    TextTrace trace(options.trace);
    run_trace(trace, run);
  } else {
    const StreamSpec spec{.kind = stream_kind(options.generate),
                          .count = options.count,
                          .gap = options.gap,
                          .seed = options.seed,
                          .write_share = options.write_share,
                          .bytes = options.bytes};
    AccessStream stream(spec, run.device());
    run_stream(spec, stream, run);
    source = fmt::format("{} stream, gap {}", options.generate, options.gap);
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
