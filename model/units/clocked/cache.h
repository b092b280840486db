// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "config/config.h"
#include "memory/cache_array.h"
#include "memory/memory_messages.h"
#include "memory/private_cache.h"
#include "units/clocked/link.h"

namespace sheaf::clocked {

/// First-level cache of a unit: tags, MSHRs, and links to the L2 and back. A line here is what is
/// fetched at a time, a sector if lines are divided. Waiters are the unit's contexts, 0 to 63.
class Cache {
 public:
  enum class Result : std::uint8_t { kHit, kPending, kNoRoom };
  /// Who is to be told of a response: bit i for waiter i.
  struct Arrival {
    std::uint64_t of_line = 0;  ///< those that waited for this line
    std::uint64_t of_room = 0;  ///< those that can ask again, since there may be room
  };

  Cache(const CacheSpec& spec, std::uint16_t requester, Link<LineRequest>& to_l2,
        Link<LineResponse>& from_l2);

  [[nodiscard]] Bytes line_size() const { return spec_.line / spec_.sectors; }
  [[nodiscard]] std::uint64_t line_of(Address address) const { return address / line_size(); }
  [[nodiscard]] Cycles hit_latency() const { return spec_.hit_latency; }

  Result read(std::uint64_t line, DataKind kind, int waiter, Cycles now);
  /// Some bytes of one line, now or once it has come.
  Result modify(Address address, Bytes bytes, DataKind kind, int waiter, Cycles now);
  /// Cycles in which the look-ups of these lines, in ascending order, find a port. Neighbouring
  /// sectors share a look-up.
  [[nodiscard]] Cycles port_cycles(std::span<const std::uint64_t> lines) const;

  [[nodiscard]] bool has_response(Cycles now) const { return from_l2_.has_arrived(now); }
  Arrival take_response(Cycles now);

  /// The dirty lines, which are clean from now on; each must be given to write_back().
  [[nodiscard]] std::vector<std::uint64_t> take_dirty_lines();
  void write_back(std::uint64_t line, DataKind kind, Cycles now);
  /// The write buffer has room.
  [[nodiscard]] bool can_write() const {
    return spec_.write.buffer == 0 || writes_out_ < spec_.write.buffer;
  }

  [[nodiscard]] bool has_pending() const { return !mshrs_.empty() || writes_out_ != 0; }
  [[nodiscard]] const CacheStats& stats() const { return stats_; }
  [[nodiscard]] const CacheKindStats& kind_stats(DataKind kind) const {
    return kind_stats_[static_cast<std::size_t>(kind)];
  }

 private:
  struct Mshr {
    std::uint64_t line = 0;
    std::uint64_t waiters = 0;
    std::uint32_t targets = 0;
    Cycles since = 0;
    DataKind kind{};
    bool dirty = false;
  };
  void count_access(DataKind kind, std::uint64_t CacheStats::*outcome);
  Result miss(std::uint64_t line, DataKind kind, int waiter, bool dirty, Cycles now);
  Result wait_for_room(std::uint64_t& counter, int waiter);
  void fill(const Mshr& mshr, Cycles now);
  void send_write(Address address, Bytes bytes, DataKind kind, Cycles now);

  const CacheSpec spec_;
  const std::uint16_t requester_;
  Link<LineRequest>& to_l2_;
  Link<LineResponse>& from_l2_;
  CacheArray array_;
  std::vector<Mshr> mshrs_;
  std::uint32_t writes_out_ = 0;  ///< not acknowledged yet, of a bounded write buffer
  std::uint64_t waiting_for_room_ = 0;
  CacheStats stats_;
  std::array<CacheKindStats, kNumDataKinds> kind_stats_;
};

}  // namespace sheaf::clocked
