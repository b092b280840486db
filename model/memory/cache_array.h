// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/units.h"
#include "config/config.h"
#include "memory/policy_array.h"

namespace sheaf {

/// Tags of a set-associative cache, or of one bank of it, with a valid and a dirty bit a sector.
/// Works on blocks, numbered by address / sector size: a line is as many neighbouring blocks as it
/// has sectors, and they share a tag. Knows no time.
///
/// LRU without sectors, which nearly all caches have, is done here, in few words; the rest by a
/// PolicyArray, which is asked when the one empty set that is then here holds nothing.
class CacheArray {
 public:
  using Victim = CacheVictim;

  explicit CacheArray(const ArrayShape& shape) {
    if (shape.sets != 0 && shape.sectors == 1 && shape.replacement == Replacement::kLru) {
      ways_ = shape.ways;
      set_mask_ = shape.sets - 1;
    } else {
      other_ = std::make_unique<PolicyArray>(shape);
    }
    entries_.resize((set_mask_ + 1) * ways_);
  }
  CacheArray(const CacheArray& other)
      : ways_(other.ways_),
        set_mask_(other.set_mask_),
        entries_(other.entries_),
        other_(other.other_ ? std::make_unique<PolicyArray>(*other.other_) : nullptr) {}
  CacheArray(CacheArray&&) = default;
  CacheArray& operator=(const CacheArray& other) { return *this = CacheArray(other); }
  CacheArray& operator=(CacheArray&&) = default;
  ~CacheArray() = default;
  /// LRU, a sector a line.
  CacheArray(std::uint64_t sets, std::uint32_t ways)
      : CacheArray(ArrayShape{.sets = sets, .ways = ways}) {}

  /// True if the block is there; makes its line the most recently used.
  bool touch(std::uint64_t block) {
    Entry* const set = set_of(block);
    const std::uint64_t wanted = block + 1;
    if (set[0].tag == wanted) return true;
    for (std::uint32_t way = 1; way < ways_; ++way) {
      if (set[way].tag == wanted) {
        move_to_front(set, way);
        return true;
      }
    }
    return other_ != nullptr && other_->touch(block);
  }

  [[nodiscard]] bool holds(std::uint64_t block) const {
    const Entry* const set = entries_.data() + (block & set_mask_) * ways_;
    if (std::any_of(set, set + ways_, [=](const Entry& e) { return e.tag == block + 1; })) {
      return true;
    }
    return other_ != nullptr && other_->holds(block);
  }

  /// Marks a block that touch() has just found as modified.
  void mark_dirty(std::uint64_t block) {
    if (other_ != nullptr) {
      other_->mark_dirty(block);
    } else {
      set_of(block)[0].dirty = true;
    }
  }

  /// Puts a block that is not there in, its line as the most recently used; returns what had to
  /// leave.
  Victim fill(std::uint64_t block, bool dirty) {
    if (other_ != nullptr) return other_->fill(block, dirty);
    Entry* const set = set_of(block);
    const Entry last = set[ways_ - 1];
    move_to_front(set, ways_ - 1);
    set[0] = {block + 1, dirty};
    if (last.tag == 0) return {};
    return {true, last.dirty ? 1U : 0U, last.tag - 1};
  }

  /// Calls f(block) for every dirty block, in the order of the sets, and cleans it.
  template <typename F>
  void clean_all(F&& f) {
    if (other_ != nullptr) other_->clean_all(f);
    for (Entry& entry : entries_) {
      if (entry.tag != 0 && entry.dirty) {
        entry.dirty = false;
        f(entry.tag - 1);
      }
    }
  }

 private:
  struct Entry {
    std::uint64_t tag = 0;  ///< block number + 1; 0: empty
    bool dirty = false;
  };
  [[nodiscard]] Entry* set_of(std::uint64_t block) {
    return entries_.data() + (block & set_mask_) * ways_;
  }
  // A set is kept in order of recency, so that the last way is the least recently used.
  static void move_to_front(Entry* set, std::uint32_t way) {
    const Entry moved = set[way];
    for (; way > 0; --way) set[way] = set[way - 1];
    set[0] = moved;
  }

  std::uint32_t ways_ = 1;
  std::uint64_t set_mask_ = 0;
  std::vector<Entry> entries_;
  std::unique_ptr<PolicyArray> other_;
};

/// The array of one of `banks` banks of a cache.
template <typename Spec>
[[nodiscard]] ArrayShape bank_shape(const Spec& spec, std::uint64_t banks) {
  const bool holds = spec.mode == CacheMode::kNormal;
  return {.sets = holds ? spec.capacity / (spec.line * spec.ways * banks) : 0,
          .ways = spec.ways,
          .sectors = spec.sectors,
          .replacement = spec.replacement,
          .seed = spec.seed};
}

}  // namespace sheaf
