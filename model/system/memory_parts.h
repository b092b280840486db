// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/units.h"
#include "config/config.h"
#include "memory/memory_messages.h"
#include "stats/report_tree.h"

namespace sheaf {

/// What stands behind the private caches, whichever way its time is simulated: the links to the
/// L2, the L2, its links back to each of them, and DRAM; with their report and laws, which are the
/// same for all.
template <template <typename> typename Link, typename L2, typename Dram>
class MemoryParts {
 public:
  MemoryParts(const MemoryParts&) = delete;
  MemoryParts& operator=(const MemoryParts&) = delete;

  [[nodiscard]] L2& l2() { return *l2_; }
  [[nodiscard]] const L2& l2() const { return *l2_; }
  [[nodiscard]] Dram& dram() { return *dram_; }
  [[nodiscard]] const Dram& dram() const { return *dram_; }

  /// Calls f(link) for each.
  template <typename F>
  void for_each_link(F&& f) const {
    for (const auto& link : requests_) f(*link);
    for (const auto& link : lines_) f(*link);
  }

  /// Bytes in = bytes out at every level, and Little's law for the L2. `fetched`, `written`: by all
  /// private caches. Throws Error(kBug) if one does not hold.
  void check_conservation(Bytes fetched, Bytes written, Cycles end) const;
  /// system.l2, system.crossbar and system.dram. `rays`: retired in the run; `spills`: of a machine
  /// that writes rays to memory.
  void report(Cycles end, std::uint64_t rays, bool spills, StatsTree& stats) const;

 protected:
  explicit MemoryParts(const LinkSpec& link) : link_(link) {}
  ~MemoryParts() = default;

  /// That so many bytes take on a private cache's way back from the L2.
  [[nodiscard]] Cycles transfer(Bytes bytes) const {
    return (bytes + link_.memory_width - 1) / link_.memory_width;
  }

  const LinkSpec link_;

  std::vector<std::unique_ptr<Link<LineRequest>>> requests_;  ///< to the L2
  std::vector<std::unique_ptr<Link<LineResponse>>> lines_;    ///< from it, to each private cache
  std::unique_ptr<L2> l2_;
  std::unique_ptr<Dram> dram_;
};

/// Counters of one private cache, in all and by kind of data.
template <typename Cache>
void report_cache(const std::string& path, const Cache& cache, StatsTree& stats);

}  // namespace sheaf
