// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/replay_summary.h"

#include <fmt/format.h>

#include "report/table.h"

namespace sheaf {
namespace {

void add_cache(TextTable& table, const StatsTree& stats, const std::string& path) {
  const std::uint64_t accesses = stats.count(path + ".num_accesses");
  if (accesses == 0) return;
  const double share =
      static_cast<double>(stats.count(path + ".num_hits")) / static_cast<double>(accesses);
  table.add_row({path.substr(path.find('.') + 1), grouped(accesses),
                 fmt::format("{:.2f} %", 100 * share), grouped(stats.count(path + ".bytes_read"))});
}

std::string change(Cycles now, Cycles before) {
  if (before == 0) return "";
  return fmt::format("{:+.2f} % of the recorded {}",
                     100 * (static_cast<double>(now) / static_cast<double>(before) - 1),
                     grouped(before));
}

}  // namespace

std::string summarize_replay(const StatsTree& stats, const TraceMetadata& metadata,
                             const std::string& mode) {
  std::string text = fmt::format("{} · memory trace of {} rays · {} replay\n", metadata.scene_name,
                                 grouped(metadata.num_rays), mode);
  const Cycles cycles = stats.count("system.cycles");
  TextTable time({Align::kLeft, Align::kRight, Align::kLeft});
  time.add_row({"cycles", grouped(cycles), change(cycles, metadata.cycles)});
  time.add_row({"DRAM bytes read", grouped(stats.count("system.dram.bytes_read")), ""});
  time.add_row({"DRAM bytes written", grouped(stats.count("system.dram.bytes_written")), ""});
  text += "\nTime and traffic\n" + time.text(2);
  TextTable memory({Align::kLeft, Align::kRight, Align::kRight, Align::kRight});
  memory.add_row({"", "accesses", "hits", "bytes read below"});
  for (const MemoryTraceStream& unit : metadata.memory.streams) {
    for (const MemoryTraceCache& cache : unit.caches) {
      add_cache(memory, stats, fmt::format("system.{}.{}", unit.name, cache.name));
    }
  }
  add_cache(memory, stats, "system.l2");
  return text + "\nMemory\n" + memory.text(2);
}

}  // namespace sheaf
