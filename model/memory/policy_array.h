// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "config/config.h"
#include "memory/tree_plru.h"

namespace sheaf {

/// What a cache's tags are made of.
struct ArrayShape {
  std::uint64_t sets = 0;  ///< a power of two; 0: holds nothing
  std::uint32_t ways = 1;
  std::uint32_t sectors = 1;  ///< a power of two up to 32
  Replacement replacement = Replacement::kLru;
  std::uint64_t seed = 0;
};

/// A line that had to leave, by its first block; bit i of `dirty`: sector i.
struct CacheVictim {
  bool valid = false;
  std::uint32_t dirty = 0;
  std::uint64_t line = 0;
};

/// Tags with any replacement and any number of sectors a line: the same calls as CacheArray, which
/// uses it for all but the common case.
class PolicyArray {
 public:
  explicit PolicyArray(const ArrayShape& shape);

  bool touch(std::uint64_t block);
  [[nodiscard]] bool holds(std::uint64_t block) const;
  void mark_dirty(std::uint64_t block) { find(block)->dirty |= bit_of(block); }
  CacheVictim fill(std::uint64_t block, bool dirty);
  template <typename F>
  void clean_all(F&& f) {
    for (Entry& entry : entries_) {
      for (std::uint32_t left = entry.dirty; left != 0; left &= left - 1) {
        f(first_block(entry) + static_cast<std::uint32_t>(std::countr_zero(left)));
      }
      entry.dirty = 0;
    }
  }

 private:
  struct Entry {
    std::uint64_t tag = 0;    ///< line number + 1; 0: empty
    std::uint32_t valid = 0;  ///< bit i: sector i
    std::uint32_t dirty = 0;
  };
  [[nodiscard]] std::uint32_t bit_of(std::uint64_t block) const {
    return 1U << (block & sector_mask_);
  }
  [[nodiscard]] std::uint64_t first_block(const Entry& entry) const {
    return (entry.tag - 1) << sector_shift_;
  }
  [[nodiscard]] std::uint64_t set_number(std::uint64_t block) const {
    return (block >> sector_shift_) & set_mask_;
  }
  [[nodiscard]] Entry* set_of(std::uint64_t block) {
    return entries_.data() + set_number(block) * ways_;
  }
  [[nodiscard]] Entry* find(std::uint64_t block);
  /// LRU and FIFO keep a set in order, so that its last way leaves next; with the others a line
  /// stays in its way.
  [[nodiscard]] bool is_ordered() const {
    return replacement_ == Replacement::kLru || replacement_ == Replacement::kFifo;
  }
  void use(std::uint64_t block, const Entry& entry);
  [[nodiscard]] std::uint32_t choose_way(std::uint64_t block);

  std::uint32_t ways_;
  unsigned sector_shift_;
  std::uint32_t sector_mask_;
  std::uint64_t set_mask_;
  Replacement replacement_;
  std::vector<Entry> entries_;
  TreePlru plru_;
  Random random_;
};

}  // namespace sheaf
