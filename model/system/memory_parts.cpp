// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/memory_parts.h"

#include <fmt/format.h>

#include "system/clocked_memory.h"
#include "system/conservation.h"
#include "system/memory_system.h"
#include "system/reported_values.h"

namespace sheaf {

template <template <typename> typename Link, typename L2, typename Dram>
void MemoryParts<Link, L2, Dram>::check_conservation(Bytes fetched, Bytes written,
                                                     Cycles end) const {
  const L2Stats& l2 = l2_->stats();
  const DramStats dram = dram_->stats(end);
  require(l2_->is_idle(), "no memory request in flight at the end");
  require_equal(l2.num_accesses, l2.num_hits + l2.num_misses + l2.num_merges,
                "l2: accesses = hits + misses + merges");
  require_equal(fetched, l2.bytes_requested, "bytes into the private caches = bytes out of the l2");
  require_equal(written, l2.bytes_received, "bytes out of the private caches = bytes into the l2");
  require_equal(l2.queue_occupancy_cycles, l2.bank_wait_cycles,
                "l2: mean occupancy of its queues = throughput x mean wait");
  require_equal(l2.mshr_occupancy_cycles, l2.sum_miss_latency,
                "l2: mean MSHRs in use = misses per cycle x mean latency");
  require_equal(l2.bytes_read, dram.bytes_read, "bytes into the l2 = bytes out of dram");
  require_equal(l2.bytes_written, dram.bytes_written, "bytes out of the l2 = bytes into dram");
}

template <template <typename> typename Link, typename L2, typename Dram>
void MemoryParts<Link, L2, Dram>::report(Cycles end, std::uint64_t rays, bool spills,
                                         StatsTree& stats) const {
  stats.add_counters("system.l2", l2_->stats());
  stats.add_ratio("system.l2", CacheValues::hit_rate, l2_->stats().num_hits,
                  l2_->stats().num_accesses);
  if (l2_->request_crossbar()) {
    stats.add_counters("system.crossbar.requests", l2_->request_crossbar()->stats());
  }
  if (l2_->response_crossbar()) {
    stats.add_counters("system.crossbar.responses", l2_->response_crossbar()->stats());
  }
  for (std::size_t i = 0; i < kNumDataKinds; ++i) {
    const auto kind = static_cast<DataKind>(i);
    if (kind == DataKind::kSpilledRay && !spills) continue;
    stats.add_counters(fmt::format("system.l2.{}", to_string(kind)), l2_->kind_stats(kind));
  }
  const DramStats dram = dram_->stats(end);
  stats.add_counters("system.dram", dram);
  stats.add_ratio("system.dram", MainMemoryValues::bytes_per_ray,
                  static_cast<double>(dram.bytes_read + dram.bytes_written),
                  static_cast<double>(rays));
  stats.add_ratio("system.dram", MainMemoryValues::bus_utilization, dram.bus_busy_cycles, end);
  dram_->report_details("system.dram", end, stats);
}

template <typename Cache>
void report_cache(const std::string& path, const Cache& cache, StatsTree& stats) {
  const CacheStats& counters = cache.stats();
  stats.add_counters(path, counters);
  stats.add_ratio(path, CacheValues::hit_rate, counters.num_hits, counters.num_accesses);
  for (std::size_t i = 0; i < kNumDataKinds; ++i) {
    const auto kind = static_cast<DataKind>(i);
    if (cache.kind_stats(kind).num_accesses == 0) continue;
    stats.add_counters(fmt::format("{}.{}", path, to_string(kind)), cache.kind_stats(kind));
  }
}

template class MemoryParts<TimedChannel, L2Cache, MainMemory>;
template class MemoryParts<clocked::Link, clocked::L2Cache, clocked::Dram>;
template void report_cache(const std::string&, const PrivateCache&, StatsTree&);
template void report_cache(const std::string&, const clocked::Cache&, StatsTree&);

}  // namespace sheaf
