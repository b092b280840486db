// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/memory_system.h"

#include <fmt/format.h>

#include "memory/banked_dram.h"
#include "memory/fixed_dram.h"
#include "system/conservation.h"
#include "system/reported_values.h"

namespace sheaf {
namespace {

// MSHRs keep these links from filling up.
constexpr std::size_t kNeverFull = TimedChannel<LineRequest>::kUnbounded;

}  // namespace

sc_core::sc_time clock_period(const Config& config) {
  return {1.0 / config.clock.frequency, sc_core::SC_SEC};
}

MemorySystem::MemorySystem(const Config& config, ClockDomain& domain)
    : link_(config.link),
      caches_to_l2_(std::make_unique<TimedChannel<LineRequest>>(
          "caches_to_l2",
          TimedChannel<LineRequest>::Spec{
              .capacity = kNeverFull, .latency = config.link.memory_latency, .interval = 0})),
      l2_(std::make_unique<L2Cache>("l2", config.l2, config.crossbar, domain)) {
  if (config.dram.model == DramModel::kFixed) {
    dram_ = std::make_unique<FixedDram>("dram", config.dram, domain.period());
  } else {
    auto banked = std::make_unique<BankedDram>("dram", resolve_dram(config.dram),
                                               config.clock.frequency, domain);
    l2_->expect_answers_from(banked->agent());
    dram_ = std::move(banked);
  }
  l2_->in_requests(*caches_to_l2_);
  l2_->to_dram.bind(dram_->from_cache);
}

std::uint16_t MemorySystem::add_requester(const CacheSpec& cache) {
  const auto number = static_cast<std::uint16_t>(l2_to_caches_.size());
  const Cycles transfer =
      (cache.line / cache.sectors + link_.memory_width - 1) / link_.memory_width;
  l2_to_caches_.push_back(std::make_unique<TimedChannel<LineResponse>>(
      fmt::format("l2_to_cache_{}", number).c_str(),
      TimedChannel<LineResponse>::Spec{
          .capacity = kNeverFull, .latency = link_.memory_latency, .interval = transfer}));
  l2_->out_responses(*l2_to_caches_.back());
  return number;
}

void MemorySystem::check_conservation(Bytes fetched, Bytes written, Cycles end) const {
  const L2Stats& l2 = l2_->stats();
  const DramStats dram = dram_->stats(end);
  require(l2_->is_idle(), "no memory request in flight at the end");
  require_equal(l2.num_accesses, l2.num_hits + l2.num_misses + l2.num_merges,
                "l2: accesses = hits + misses + merges");
  require_equal(fetched, l2.bytes_requested, "bytes into the private caches = bytes out of the l2");
  require_equal(written, l2.bytes_received, "bytes out of the private caches = bytes into the l2");
  require_equal(l2.bytes_read, dram.bytes_read, "bytes into the l2 = bytes out of dram");
  require_equal(l2.bytes_written, dram.bytes_written, "bytes out of the l2 = bytes into dram");
}

void MemorySystem::report(Cycles end, std::uint64_t rays, StatsTree& stats) const {
  stats.add_counters("system.l2", l2_->stats());
  stats.add_ratio("system.l2", CacheValues::hit_rate, l2_->stats().num_hits,
                  l2_->stats().num_accesses);
  for (std::size_t kind = 0; kind < kNumDataKinds; ++kind) {
    if (static_cast<DataKind>(kind) == DataKind::kSpilledRay) continue;
    const std::string path = fmt::format("system.l2.{}", to_string(static_cast<DataKind>(kind)));
    stats.add_counters(path, l2_->kind_stats(static_cast<DataKind>(kind)));
  }
  if (l2_->request_crossbar()) {
    stats.add_counters("system.crossbar.requests", l2_->request_crossbar()->stats());
  }
  if (l2_->response_crossbar()) {
    stats.add_counters("system.crossbar.responses", l2_->response_crossbar()->stats());
  }
  const DramStats dram = dram_->stats(end);
  stats.add_counters("system.dram", dram);
  stats.add_ratio("system.dram", MainMemoryValues::bytes_per_ray,
                  static_cast<double>(dram.bytes_read + dram.bytes_written),
                  static_cast<double>(rays));
  stats.add_ratio("system.dram", MainMemoryValues::bus_utilization, dram.bus_busy_cycles, end);
  dram_->report_details("system.dram", end, stats);
}

void report_cache(const std::string& path, const PrivateCache& cache, StatsTree& stats) {
  const CacheStats& counters = cache.stats();
  stats.add_counters(path, counters);
  stats.add_ratio(path, CacheValues::hit_rate, counters.num_hits, counters.num_accesses);
  for (std::size_t i = 0; i < kNumDataKinds; ++i) {
    const auto kind = static_cast<DataKind>(i);
    if (cache.kind_stats(kind).num_accesses == 0) continue;
    stats.add_counters(fmt::format("{}.{}", path, to_string(kind)), cache.kind_stats(kind));
  }
}

}  // namespace sheaf
