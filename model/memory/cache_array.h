// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/units.h"

namespace sheaf {

/// Tags of a set-associative cache with LRU replacement and a dirty bit a line. Works on line
/// numbers (address / line size); knows no time.
class CacheArray {
 public:
  /// `num_sets` is a power of two. A cache of 0 sets holds nothing.
  CacheArray(std::uint32_t num_sets, std::uint32_t ways)
      : ways_(ways), set_mask_(num_sets - 1), entries_(std::size_t{num_sets} * ways) {}

  struct Victim {
    bool valid = false;
    bool dirty = false;
    std::uint64_t line = 0;
  };

  /// True if the line is there; makes it the most recently used.
  bool touch(std::uint64_t line) {
    if (entries_.empty()) return false;
    Entry* const set = set_of(line);
    const std::uint64_t wanted = tag_of(line);
    if (set[0].tag == wanted) return true;
    for (std::uint32_t way = 1; way < ways_; ++way) {
      if (set[way].tag == wanted) {
        move_to_front(set, way);
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool holds(std::uint64_t line) const {
    if (entries_.empty()) return false;
    const Entry* const set = entries_.data() + (line & set_mask_) * ways_;
    return std::any_of(set, set + ways_,
                       [&](const Entry& entry) { return entry.tag == tag_of(line); });
  }

  /// Marks a line that touch() has just found as modified.
  void mark_dirty(std::uint64_t line) { set_of(line)[0].dirty = true; }

  /// Puts a line that is not there in, as the most recently used; returns what had to leave.
  Victim fill(std::uint64_t line, bool dirty) {
    if (entries_.empty()) return {true, dirty, line};
    Entry* const set = set_of(line);
    const Entry last = set[ways_ - 1];
    move_to_front(set, ways_ - 1);
    set[0] = {tag_of(line), dirty};
    if (last.tag == 0) return {};
    return {true, last.dirty, last.tag - 1};
  }

  /// Forgets a line, dirty or not, if it is there.
  void remove(std::uint64_t line) {
    if (!touch(line)) return;
    Entry* const set = set_of(line);
    std::rotate(set, set + 1, set + ways_);
    set[ways_ - 1] = {};
  }

  /// Calls f(line) for every dirty line, in the order of the sets, and cleans it.
  template <typename F>
  void clean_all(F&& f) {
    for (Entry& entry : entries_) {
      if (entry.tag != 0 && entry.dirty) {
        entry.dirty = false;
        f(entry.tag - 1);
      }
    }
  }

 private:
  struct Entry {
    std::uint64_t tag = 0;  ///< line number + 1; 0: empty
    bool dirty = false;
  };
  [[nodiscard]] static std::uint64_t tag_of(std::uint64_t line) { return line + 1; }
  [[nodiscard]] Entry* set_of(std::uint64_t line) {
    return entries_.data() + (line & set_mask_) * ways_;
  }
  // A set is kept in order of recency, so that the last way is the least recently used.
  static void move_to_front(Entry* set, std::uint32_t way) {
    const Entry moved = set[way];
    for (; way > 0; --way) set[way] = set[way - 1];
    set[0] = moved;
  }

  std::uint32_t ways_;
  std::uint64_t set_mask_;
  std::vector<Entry> entries_;
};

}  // namespace sheaf
