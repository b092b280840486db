// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "channels/clock_domain.h"
#include "memory/l2_cache.h"
#include "memory/main_memory.h"
#include "memory/private_cache.h"
#include "stats/report_tree.h"

namespace sheaf {

[[nodiscard]] sc_core::sc_time clock_period(const Config& config);

/// What stands behind the private caches: their common link to the L2, the L2, its links back to
/// each of them, and DRAM.
class MemorySystem {
 public:
  MemorySystem(const Config& config, ClockDomain& domain);

  /// Makes the link that brings the lines of one more private cache; returns the cache's number at
  /// the L2.
  [[nodiscard]] std::uint16_t add_requester(const CacheSpec& cache);
  /// The link of that number.
  [[nodiscard]] TimedChannel<LineResponse>& lines(std::uint16_t requester) {
    return *l2_to_caches_[requester];
  }
  [[nodiscard]] TimedOut<LineRequest>& requests() { return *caches_to_l2_; }

  [[nodiscard]] const L2Cache& l2() const { return *l2_; }
  [[nodiscard]] const MainMemory& dram() const { return *dram_; }

  /// Bytes in = bytes out at every level. `fetched`, `written`: by all private caches.
  void check_conservation(Bytes fetched, Bytes written, Cycles end) const;
  /// system.l2 and system.dram; `rays`: retired in the run.
  void report(Cycles end, std::uint64_t rays, StatsTree& stats) const;

 private:
  const LinkSpec link_;
  std::unique_ptr<TimedChannel<LineRequest>> caches_to_l2_;
  std::vector<std::unique_ptr<TimedChannel<LineResponse>>> l2_to_caches_;
  std::unique_ptr<L2Cache> l2_;
  std::unique_ptr<MainMemory> dram_;
};

/// Counters of one private cache, in all and by kind of data.
void report_cache(const std::string& path, const PrivateCache& cache, StatsTree& stats);

}  // namespace sheaf
