// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "memory/private_cache.h"
#include "tracefile/memory_stream.h"

namespace sheaf {

/// A unit of a fixed replay: presents its accesses in the cycles in which they were recorded,
/// whatever becomes of them; later only if MSHRs were lacking, and then one step a cycle until it
/// has caught up. Writes modified lines back in the end.
class FixedUnit final : public sc_core::sc_module, public Agent {
 public:
  FixedUnit(const sc_core::sc_module_name& name, const MemoryLayout& layout, MemoryStream records,
            ClockDomain& domain);

  /// In the order of the stream's caches, all of them before the simulation starts.
  void add_cache(const CacheSpec& spec, TimedOut<LineRequest>& requests, std::uint16_t requester,
                 TimedIn<LineResponse>& lines);

  Cycles wake(Cycles now) override;

  [[nodiscard]] const PrivateCache& cache(std::size_t i) const { return caches_[i]->cache; }
  [[nodiscard]] bool is_finished() const;

 private:
  struct Own {
    Own(const CacheSpec& spec, TimedOut<LineRequest>& requests, std::uint16_t requester,
        TimedIn<LineResponse>& link)
        : cache(spec, requests, requester), lines(link) {}
    PrivateCache cache;
    TimedIn<LineResponse>& lines;
  };
  Cycles act(Cycles now);
  void take_lines(Cycles now);
  bool load_step();
  bool present(Cycles now);
  Cycles flush_next(Cycles now);

  const MemoryLayout& layout_;
  MemoryStream records_;
  ClockDomain& domain_;
  Inbox inbox_;
  std::vector<std::unique_ptr<Own>> caches_;
  // The step in hand; lines are taken from the end.
  MemoryRecord step_;
  std::vector<std::uint64_t> lines_;
  Bytes bytes_done_ = 0;  ///< of a write
  bool all_read_ = false;
  bool waits_for_mshr_ = false;
  std::vector<std::uint64_t> dirty_lines_;
  std::size_t dirty_cache_ = 0;  ///< the caches before it have been cleaned
};

}  // namespace sheaf
