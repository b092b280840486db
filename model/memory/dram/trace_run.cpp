// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/trace_run.h"

#include <algorithm>

#include "memory/dram/dram_report.h"

namespace sheaf {
namespace {

// How often the memory is brought up to date: seldom enough to be cheap, often enough to keep what
// waits small.
constexpr std::uint64_t kAdvanceEvery = 1024;
constexpr std::size_t kMostWaiting = 64;

void report_latency(const std::string& path, const LatencyRecord& record, StatsTree& stats) {
  stats.add(path + ".num", record.num(), "requests", "Requests of this kind");
  stats.add_ratio(path + ".mean", record.sum(), record.num(), "tCK",
                  "Mean latency, acceptance to last byte");
  for (const auto& [name, percent] : {std::pair{".p50", 50.0}, std::pair{".p90", 90.0},
                                      std::pair{".p99", 99.0}, std::pair{".p99_9", 99.9}}) {
    stats.add(path + name, record.percentile(percent), "tCK",
              "Latency that this share of the requests does not exceed");
  }
  stats.add(path + ".max", record.max(), "tCK", "Longest latency");
}

}  // namespace

double TraceRun::Result::bandwidth(std::uint64_t clock_hz) const {
  if (end <= first_arrival) return 0;
  return static_cast<double>(bytes) * static_cast<double>(clock_hz) /
         static_cast<double>(end - first_arrival);
}

TraceRun::TraceRun(const DramDevice& device, Bytes bytes)
    : memory_(device), bytes_(bytes), capacity_(device.organization.capacity()) {}

void TraceRun::take(const DramSystem::Done& done) {
  (done.write ? result_.write_latency : result_.read_latency).record(done.at - done.accepted);
  const Cycles wait = done.accepted - done.arrival;
  result_.sum_waits += static_cast<double>(wait);
  result_.max_wait = std::max(result_.max_wait, wait);
  result_.end = std::max(result_.end, done.at);
}

void TraceRun::add(const TraceAccess& access) {
  if (num_accesses_++ == 0) result_.first_arrival = access.arrival;
  if (access.address >= capacity_) ++result_.num_wrapped;
  result_.bytes += bytes_;
  memory_.push({.arrival = access.arrival,
                .address = access.address % capacity_,
                .bytes = bytes_,
                .write = access.write});
  if (++num_since_advance_ < kAdvanceEvery) return;
  num_since_advance_ = 0;
  const auto taken = [this](const DramSystem::Done& done) { take(done); };
  memory_.advance(access.arrival, taken);
  memory_.relieve(kMostWaiting, taken);
}

void TraceRun::finish() {
  memory_.advance(kNever, [this](const DramSystem::Done& done) { take(done); });
  result_.end = std::max(result_.end, memory_.now());
  result_.channels = memory_.stats(result_.end);
}

void report_trace_run(const TraceRun& run, StatsTree& stats) {
  const TraceRun::Result& result = run.result();
  const DramDevice& device = run.device();
  stats.add("memory.num_requests", result.read_latency.num() + result.write_latency.num(),
            "requests", "Accesses of the trace");
  stats.add("memory.bytes", result.bytes, "bytes", "Bytes asked for");
  report_latency("memory.read_latency", result.read_latency, stats);
  report_latency("memory.write_latency", result.write_latency, stats);
  stats.add_ratio("memory.wait.mean", result.sum_waits,
                  static_cast<double>(result.read_latency.num() + result.write_latency.num()),
                  "tCK", "Mean wait for room in a queue, not in the latency");
  stats.add("memory.wait.max", result.max_wait, "tCK", "Longest wait for room in a queue");
  stats.add_real("memory.bandwidth", result.bandwidth(device.clock_hz), "bytes/s",
                 "Bytes over the time from the first arrival to the last byte");
  stats.add_real("memory.peak_bandwidth", device.peak_bandwidth(), "bytes/s",
                 "What the data buses could move");
  stats.add("memory.num_wrapped", result.num_wrapped, "requests",
            "Accesses beyond the capacity, wrapped into it");
  report_dram("memory", device, result.channels, result.end, stats);
}

}  // namespace sheaf
