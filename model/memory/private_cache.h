// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "channels/timed_channel.h"
#include "config/config.h"
#include "memory/cache_array.h"
#include "memory/memory_messages.h"
#include "stats/counters.h"

namespace sheaf {

// Every access ends as exactly one of hit, miss or merge.
#define SHEAF_CACHE_COUNTERS(X)                                               \
  X(num_accesses, "lines", "Line accesses")                                   \
  X(num_hits, "lines", "Accesses that found their line")                      \
  X(num_misses, "lines", "Accesses that sent a request to the next level")    \
  X(num_merges, "lines", "Accesses to a line that was on its way already")    \
  X(num_mshr_stalls, "events", "Times an access had to wait for a free MSHR") \
  X(num_writebacks, "lines", "Modified lines written to the next level")      \
  X(bytes_read, "bytes", "Bytes fetched from the next level")                 \
  X(bytes_written, "bytes", "Bytes written to the next level")
SHEAF_STATS(CacheStats, SHEAF_CACHE_COUNTERS);

#define SHEAF_CACHE_KIND_COUNTERS(X)                             \
  X(num_accesses, "lines", "Line accesses to this kind of data") \
  X(num_hits, "lines", "Of these, found in the cache")
SHEAF_STATS(CacheKindStats, SHEAF_CACHE_KIND_COUNTERS);

/// First-level cache of one unit with its MSHRs and its end of the link to the L2. Belongs to the
/// unit's agent and acts when the unit does: the unit presents accesses in order of time and hands
/// on the responses.
///
/// Waiters are the unit's contexts (0 to 63). A waiter that gets kPending is named by the fill of
/// its line; one that gets kNoMshr is named when an MSHR has become free, and asks again.
class PrivateCache {
 public:
  enum class Result : std::uint8_t { kHit, kPending, kNoMshr };

  PrivateCache(const CacheSpec& spec, TimedOut<LineRequest>& requests, std::uint16_t requester);

  [[nodiscard]] std::uint64_t line_of(Address address) const { return address >> line_shift_; }
  [[nodiscard]] Cycles hit_latency() const { return spec_.hit_latency; }

  /// `owner`: the agent that presents the accesses.
  void bind(const Inbox& owner) { requests_.add_producer(owner); }

  /// One access to a line at cycle `now`.
  Result read(std::uint64_t line, DataKind kind, int waiter, Cycles now) {
    if (spec_.mode == CacheMode::kPerfect || array_.touch(line)) {
      count_hit(kind);
      return Result::kHit;
    }
    return miss(line, kind, waiter, false, now);
  }
  /// As read() if the line is there; else false, and nothing happens.
  bool read_if_hit(std::uint64_t line, DataKind kind) {
    if (spec_.mode != CacheMode::kPerfect && !array_.touch(line)) return false;
    count_hit(kind);
    return true;
  }
  [[nodiscard]] bool holds(std::uint64_t line) const {
    return spec_.mode == CacheMode::kPerfect || array_.holds(line);
  }
  /// As read(), for a read-modify-write: the line is dirty from now on, or once it has arrived.
  Result modify(std::uint64_t line, DataKind kind, int waiter, Cycles now);

  /// Takes in an arrived line. Returns the waiters of this line (bit i: waiter i); waiters for a
  /// free MSHR are added to `retry`.
  std::uint64_t fill(const LineResponse& response, Cycles now, std::uint64_t& retry);

  /// The dirty lines, which are clean from now on; each must be given to write_back().
  [[nodiscard]] std::vector<std::uint64_t> take_dirty_lines();
  void write_back(std::uint64_t line, Cycles now);

  /// Takes over the tags of a cache of the same shape, but for lines that are on their way; counts
  /// nothing.
  void load(const CacheArray& tags);

  [[nodiscard]] bool has_pending() const { return num_mshrs_used_ != 0; }
  [[nodiscard]] const CacheStats& stats() const { return stats_; }
  [[nodiscard]] const CacheKindStats& kind_stats(DataKind kind) const {
    return kind_stats_[static_cast<std::size_t>(kind)];
  }

 private:
  struct Mshr {
    std::uint64_t line = 0;
    std::uint64_t waiters = 0;
    DataKind kind{};
    bool dirty = false;
  };
  void count_access(DataKind kind) {
    ++stats_.num_accesses;
    ++kind_stats_[static_cast<std::size_t>(kind)].num_accesses;
  }
  void count_hit(DataKind kind) {
    count_access(kind);
    ++stats_.num_hits;
    ++kind_stats_[static_cast<std::size_t>(kind)].num_hits;
  }
  Result miss(std::uint64_t line, DataKind kind, int waiter, bool dirty, Cycles now);

  const CacheSpec spec_;
  unsigned line_shift_;
  CacheArray array_;
  std::vector<Mshr> mshrs_;  ///< the first num_mshrs_used_ are in use
  std::uint32_t num_mshrs_used_ = 0;
  std::uint64_t waiting_for_mshr_ = 0;
  TimedOut<LineRequest>& requests_;
  std::uint16_t requester_;
  DataKind written_kind_{};
  CacheStats stats_;
  std::array<CacheKindStats, kNumDataKinds> kind_stats_;
};

}  // namespace sheaf
