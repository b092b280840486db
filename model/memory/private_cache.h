// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
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
#define SHEAF_CACHE_COUNTERS(X)                                                                \
  X(num_accesses, "lines", "Line accesses")                                                    \
  X(num_hits, "lines", "Accesses that found their line")                                       \
  X(num_misses, "lines", "Accesses that sent a request to the next level")                     \
  X(num_merges, "lines", "Accesses to a line that was on its way already")                     \
  X(num_mshr_stalls, "events", "Times an access had to wait for a free MSHR")                  \
  X(num_target_stalls, "events", "Times as many accesses waited for a line as its MSHR takes") \
  X(num_write_stalls, "events", "Times an access had to wait for the write buffer")            \
  X(num_writebacks, "lines", "Modified lines written to the next level")                       \
  X(num_writes_through, "writes", "Writes passed on to the next level at once")                \
  X(bytes_read, "bytes", "Bytes fetched from the next level")                                  \
  X(bytes_written, "bytes", "Bytes written to the next level")                                 \
  X(sum_miss_latency, "cycles", "Time from a miss to its line, summed over misses")            \
  X(mshr_occupancy_cycles, "cycles", "MSHRs in use, summed over all cycles")
SHEAF_STATS(CacheStats, SHEAF_CACHE_COUNTERS);

#define SHEAF_CACHE_KIND_COUNTERS(X)                             \
  X(num_accesses, "lines", "Line accesses to this kind of data") \
  X(num_hits, "lines", "Of these, found in the cache")
SHEAF_STATS(CacheKindStats, SHEAF_CACHE_KIND_COUNTERS);

/// First-level cache of one unit with its MSHRs and its end of the link to the L2. Belongs to the
/// unit's agent and acts when the unit does: the unit presents accesses in order of time and hands
/// on the responses.
///
/// A line here is what is fetched at a time, so a sector if lines are divided.
///
/// Waiters are the unit's contexts (0 to 63). A waiter that gets kPending is named by the fill of
/// its line; one that gets kNoMshr, for want of an MSHR, of a target in it or of room in the write
/// buffer, is named when some of that may have become free, and asks again.
class PrivateCache {
 public:
  enum class Result : std::uint8_t { kHit, kPending, kNoMshr };

  PrivateCache(const CacheSpec& spec, TimedOut<LineRequest>& requests, std::uint16_t requester);

  [[nodiscard]] std::uint64_t line_of(Address address) const { return address >> line_shift_; }
  [[nodiscard]] Bytes line_size() const { return Bytes{1} << line_shift_; }
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
  /// As read(), for a read-modify-write of some bytes of one line, which is dirty from now on or
  /// once it has arrived; with write-through the bytes, or what has gathered in the MSHR, go on.
  Result modify(Address address, Bytes bytes, DataKind kind, int waiter, Cycles now);

  /// Cycles in which the look-ups of these neighbouring lines find a port.
  [[nodiscard]] Cycles port_cycles(std::uint64_t first, std::uint64_t last) const {
    const std::uint64_t tags = (last >> sector_shift_) - (first >> sector_shift_) + 1;
    return lookups_per_cycle_ == 1 ? tags : (tags + lookups_per_cycle_ - 1) / lookups_per_cycle_;
  }
  /// The same for any lines in ascending order: line(i) for i from begin to end.
  template <typename LineOf>
  [[nodiscard]] Cycles port_cycles(std::uint32_t begin, std::uint32_t end,
                                   const LineOf& line) const;
  /// Whether a look-up takes a cycle, whatever the lines.
  [[nodiscard]] bool is_plain() const { return is_plain_; }

  /// Takes in an arrived line. Returns the waiters of this line (bit i: waiter i); waiters for a
  /// free MSHR are added to `retry`.
  std::uint64_t fill(const LineResponse& response, Cycles now, std::uint64_t& retry);

  /// The dirty lines, which are clean from now on; each must be given to write_back().
  [[nodiscard]] std::vector<std::uint64_t> take_dirty_lines();
  void write_back(std::uint64_t line, Cycles now);
  /// Whether the write buffer has room; if not, a response will bring it.
  [[nodiscard]] bool can_write() const {
    return spec_.write.buffer == 0 || num_writes_out_ < spec_.write.buffer;
  }

  /// Takes over the tags of a cache of the same shape; counts nothing. Of a line that is on its way
  /// there may be one already when it comes.
  void load(const CacheArray& tags);

  [[nodiscard]] bool has_pending() const { return num_mshrs_used_ != 0 || num_writes_out_ != 0; }
  [[nodiscard]] const CacheStats& stats() const { return stats_; }
  [[nodiscard]] const CacheKindStats& kind_stats(DataKind kind) const {
    return kind_stats_[static_cast<std::size_t>(kind)];
  }

 private:
  struct Mshr {
    std::uint64_t line = 0;
    std::uint64_t waiters = 0;
    Cycles since = 0;
    std::uint32_t targets = 0;
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
  Result wait_for_room(std::uint64_t& counter, int waiter);
  void count_occupancy(Cycles now);
  bool writes_arrived(std::uint64_t line, Cycles now);
  void send_write(Address address, Bytes bytes, Cycles now);

  const CacheSpec spec_;
  unsigned line_shift_;
  unsigned sector_shift_;
  std::uint64_t lookups_per_cycle_;
  bool is_plain_;
  std::uint32_t most_targets_;
  CacheArray array_;
  bool was_loaded_ = false;
  std::vector<Mshr> mshrs_;  ///< the first num_mshrs_used_ are in use
  std::uint32_t num_mshrs_used_ = 0;
  std::uint64_t waiting_for_room_ = 0;
  TimedOut<LineRequest>& requests_;
  std::uint16_t requester_;
  DataKind written_kind_{};
  std::uint32_t num_writes_out_ = 0;  ///< of a bounded write buffer
  Cycles counted_until_ = 0;          ///< of mshr_occupancy_cycles
  CacheStats stats_;
  std::array<CacheKindStats, kNumDataKinds> kind_stats_;
};

template <typename LineOf>
Cycles PrivateCache::port_cycles(std::uint32_t begin, std::uint32_t end, const LineOf& line) const {
  std::array<std::uint32_t, 64> lookups{};
  std::uint32_t most = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint64_t tag = line(i) >> sector_shift_;
    if (i > begin && tag == line(i - 1) >> sector_shift_) continue;
    most = std::max(most, ++lookups[tag & (spec_.banks - 1)]);
  }
  return (most + spec_.ports - 1) / spec_.ports;
}

}  // namespace sheaf
