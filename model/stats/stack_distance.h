// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "stats/recency_order.h"

namespace sheaf {

/// LRU stack distances of a stream of lines: how many other lines of the same set have been used
/// since this line was. An access hits in a cache of w ways (and this number of sets, with LRU
/// replacement) if and only if its distance is less than w, so that one pass tells for all sizes.
/// (R. L. Mattson et al., "Evaluation techniques for storage hierarchies", IBM Syst. J. 9(2),
/// 1970.)
///
/// An access costs O(log M), memory grows with the number M of distinct lines, some 60 bytes each:
/// a hash table of lines with open addressing, and a RecencyOrder a set.
class StackDistances {
 public:
  /// Of a line that was never used before.
  static constexpr std::uint32_t kFirstUse = std::numeric_limits<std::uint32_t>::max();

  /// `num_sets`: a power of two; line number modulo num_sets names the set.
  explicit StackDistances(std::uint32_t num_sets = 1);

  /// The distance of this access. Up to 2^30 distinct lines.
  std::uint32_t access(std::uint64_t line) {
    Slot* slot = find(line);
    if (slot->stamp == kEmpty) return access_first(line, slot);
    RecencyOrder& order = orders_[line & set_mask_];
    if (slot->stamp == order.last()) return 0;
    const std::uint32_t distance = order.pull(slot->stamp);
    use(order, slot);
    return distance;
  }

  /// Calls f(distance) for each of many accesses in turn: fetches what the next ones need ahead,
  /// for speed.
  template <typename F>
  void access_all(std::span<const std::uint64_t> lines, F&& f) {
    constexpr std::size_t kAhead = 12;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (i + kAhead < lines.size()) __builtin_prefetch(&slots_[home_of(lines[i + kAhead])]);
      f(access(lines[i]));
    }
  }

  [[nodiscard]] std::uint32_t num_sets() const {
    return static_cast<std::uint32_t>(orders_.size());
  }
  [[nodiscard]] std::uint64_t num_lines() const { return num_lines_; }

 private:
  static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();
  struct Slot {
    std::uint64_t line = 0;
    std::uint32_t stamp = kEmpty;  ///< in the order of its set
  };

  // Multiplicative hashing with the golden ratio (D. E. Knuth, TAOCP vol. 3, 6.4).
  [[nodiscard]] std::size_t home_of(std::uint64_t line) const {
    return static_cast<std::size_t>((line * 0x9E3779B97F4A7C15U) >> hash_shift_);
  }
  /// The line's slot, or the empty one where it belongs.
  [[nodiscard]] Slot* find(std::uint64_t line) {
    std::size_t i = home_of(line);
    while (slots_[i].stamp != kEmpty && slots_[i].line != line) i = (i + 1) & (slots_.size() - 1);
    return &slots_[i];
  }
  void use(RecencyOrder& order, Slot* slot) {
    if (order.is_full()) renumber(order);
    slot->stamp = order.push(static_cast<std::uint32_t>(slot - slots_.data()));
  }
  std::uint32_t access_first(std::uint64_t line, Slot* slot);
  void renumber(RecencyOrder& order);
  void grow();

  std::uint64_t set_mask_;
  unsigned hash_shift_;
  std::vector<Slot> slots_;  ///< a power of two, at most half of them taken
  std::uint64_t num_lines_ = 0;
  std::vector<RecencyOrder> orders_;
};

/// Misses of an LRU cache for every number of ways, from the distances of its accesses.
class MissCurve {
 public:
  void add(std::uint32_t distance) {
    ++num_accesses_;
    if (distance == StackDistances::kFirstUse) return;
    if (distance >= at_distance_.size()) at_distance_.resize(distance + std::size_t{1});
    ++at_distance_[distance];
  }

  [[nodiscard]] std::uint64_t num_accesses() const { return num_accesses_; }

  struct Point {
    std::uint64_t ways = 0;
    std::uint64_t misses = 0;
  };
  /// For 0 ways, and for each number of ways that has fewer misses than one way less.
  [[nodiscard]] std::vector<Point> points() const;

 private:
  std::uint64_t num_accesses_ = 0;
  std::vector<std::uint64_t> at_distance_;
};

/// The misses of `ways` ways, by points().
[[nodiscard]] std::uint64_t misses_at(std::span<const MissCurve::Point> points, std::uint64_t ways);

}  // namespace sheaf
