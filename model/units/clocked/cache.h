// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "config/config.h"
#include "memory/cache_array.h"
#include "memory/memory_messages.h"
#include "memory/private_cache.h"
#include "units/clocked/link.h"

namespace sheaf::clocked {

/// First-level cache of a unit: tags, MSHRs, and links to the L2 and back. Waiters are the unit's
/// contexts, 0 to 63.
class Cache {
 public:
  enum class Result : std::uint8_t { kHit, kPending, kNoMshr };
  /// Who is to be told of a line: bit i for waiter i.
  struct Arrival {
    std::uint64_t of_line = 0;  ///< those that waited for it
    std::uint64_t of_mshr = 0;  ///< those that can ask again, since an MSHR is free
  };

  Cache(const CacheSpec& spec, std::uint16_t requester, Link<LineRequest>& to_l2,
        Link<LineResponse>& from_l2);

  [[nodiscard]] std::uint64_t line_of(Address address) const { return address / spec_.line; }
  [[nodiscard]] Cycles hit_latency() const { return spec_.hit_latency; }

  /// `dirty`: to be modified, now or once it has come.
  Result access(std::uint64_t line, DataKind kind, int waiter, bool dirty, Cycles now);

  [[nodiscard]] bool line_has_arrived(Cycles now) const { return from_l2_.has_arrived(now); }
  Arrival take_line(Cycles now);

  /// The dirty lines, which are clean from now on; each must be given to write_back().
  [[nodiscard]] std::vector<std::uint64_t> take_dirty_lines();
  void write_back(std::uint64_t line, DataKind kind, Cycles now);

  [[nodiscard]] bool has_pending() const { return !mshrs_.empty(); }
  [[nodiscard]] const CacheStats& stats() const { return stats_; }
  [[nodiscard]] const CacheKindStats& kind_stats(DataKind kind) const {
    return kind_stats_[static_cast<std::size_t>(kind)];
  }

 private:
  struct Mshr {
    std::uint64_t line = 0;
    std::uint64_t waiters = 0;
    Cycles since = 0;
    DataKind kind{};
    bool dirty = false;
  };
  void count_access(DataKind kind, std::uint64_t CacheStats::*outcome);

  const CacheSpec spec_;
  const std::uint16_t requester_;
  Link<LineRequest>& to_l2_;
  Link<LineResponse>& from_l2_;
  CacheArray array_;
  std::vector<Mshr> mshrs_;
  std::uint64_t waiting_for_mshr_ = 0;
  CacheStats stats_;
  std::array<CacheKindStats, kNumDataKinds> kind_stats_;
};

}  // namespace sheaf::clocked
