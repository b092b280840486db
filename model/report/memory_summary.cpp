// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/memory_summary.h"

#include <fmt/format.h>

#include "memory/dram/energy.h"
#include "report/table.h"

namespace sheaf {
namespace {

std::string shared(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "-";
  return fmt::format("{:.2f} %", 100 * static_cast<double>(part) / static_cast<double>(whole));
}

void add_latency(TextTable& table, const std::string& name, const LatencyRecord& record,
                 double ns) {
  if (record.num() == 0) return;
  const double mean = static_cast<double>(record.sum()) / static_cast<double>(record.num());
  table.add_row({name, grouped(record.num()), fmt::format("{:.2f}", mean),
                 fmt::format("{:.1f} ns", mean * ns), fmt::format("{}", record.percentile(50)),
                 fmt::format("{}", record.percentile(90)), fmt::format("{}", record.percentile(99)),
                 fmt::format("{}", record.max())});
}

std::string latency_part(const TraceRun::Result& result, double ns) {
  TextTable table({Align::kLeft, Align::kRight, Align::kRight, Align::kRight, Align::kRight,
                   Align::kRight, Align::kRight, Align::kRight});
  table.add_row({"", "requests", "mean", "", "p50", "p90", "p99", "max"});
  add_latency(table, "read", result.read_latency, ns);
  add_latency(table, "write", result.write_latency, ns);
  return "Latency, tCK, acceptance to last byte\n" + table.text(2);
}

std::string queue_part(const TraceRun::Result& result) {
  const std::uint64_t num = result.read_latency.num() + result.write_latency.num();
  const double wait = num == 0 ? 0 : result.sum_waits / static_cast<double>(num);
  return fmt::format("  wait for room in the queue: mean {:.2f}, longest {}\n", wait,
                     result.max_wait);
}

std::string rows_part(const DramChannelStats& counts) {
  const std::uint64_t served =
      counts.num_row_hits + counts.num_row_misses + counts.num_row_conflicts;
  TextTable table({Align::kLeft, Align::kRight, Align::kRight});
  table.add_row({"hits", grouped(counts.num_row_hits), shared(counts.num_row_hits, served)});
  table.add_row({"misses", grouped(counts.num_row_misses), shared(counts.num_row_misses, served)});
  table.add_row(
      {"conflicts", grouped(counts.num_row_conflicts), shared(counts.num_row_conflicts, served)});
  return "Rows\n" + table.text(2);
}

std::string bandwidth_part(const TraceRun& run) {
  const double bandwidth = run.result().bandwidth(run.device().clock_hz);
  const double peak = run.device().peak_bandwidth();
  return fmt::format("Bandwidth\n  {:.3f} GB/s of {:.3f} GB/s ({:.2f} %), {} tCK\n",
                     bandwidth / 1e9, peak / 1e9, 100 * bandwidth / peak,
                     grouped(run.result().end));
}

std::string energy_part(const TraceRun& run) {
  const TraceRun::Result& result = run.result();
  const auto items = dram_energy(run.device(), result.channels, result.end);
  TextTable table({Align::kLeft, Align::kRight});
  for (const DramEnergyItem& item : items) {
    table.add_row({std::string(item.what.name),
                   item.picojoule ? fmt::format("{:.3f} uJ", *item.picojoule / 1e6) : "unknown"});
  }
  const double known = known_energy(items);
  table.add_row({"sum of the known", fmt::format("{:.3f} uJ", known / 1e6)});
  const double bits = 8 * static_cast<double>(result.bytes);
  if (bits > 0) table.add_row({"a bit", fmt::format("{:.3f} pJ", known / bits)});
  return "Energy\n" + table.text(2) + fmt::format("  source: {}\n", run.device().energy.source);
}

}  // namespace

std::string summarize_memory(const TraceRun& run, const std::string& source) {
  const DramDevice& device = run.device();
  const TraceRun::Result& result = run.result();
  const double ns = 1e9 / static_cast<double>(device.clock_hz);
  const DramOrganization& o = device.organization;
  std::string text =
      fmt::format("{} · {} · {} channel{}, {} rank{}, {} x {} banks, tCK {:.4g} ns\n\n", source,
                  device.name, o.channels, o.channels == 1 ? "" : "s", o.ranks,
                  o.ranks == 1 ? "" : "s", o.bank_groups, o.banks, ns);
  text += latency_part(result, ns) + queue_part(result) + '\n';
  text += rows_part(result.channels) + '\n';
  text += bandwidth_part(run) + '\n';
  text += energy_part(run);
  return text;
}

}  // namespace sheaf
