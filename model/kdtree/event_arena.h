// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "kdtree/split_event.h"

namespace sheaf {

/// A stack of memory for events. Addresses stay valid until released; released memory is used
/// again.
class EventArena {
 public:
  struct Mark {
    std::size_t block = 0;
    std::size_t used = 0;
  };

  [[nodiscard]] Mark mark() const { return {block_, used_}; }

  /// Frees everything allocated after the mark was taken.
  void release(Mark mark) {
    block_ = mark.block;
    used_ = mark.used;
    const std::size_t first_free = block_ + (used_ > 0 ? 1 : 0);
    if (first_free >= blocks_.size()) return;
    const auto is_large = [](const Block& block) { return block.size > kLargestKept; };
    blocks_.erase(std::remove_if(blocks_.begin() + static_cast<std::ptrdiff_t>(first_free),
                                 blocks_.end(), is_large),
                  blocks_.end());
  }

  /// Uninitialised room for `count` events.
  [[nodiscard]] SplitEvent* allocate(std::size_t count) {
    while (block_ < blocks_.size() && blocks_[block_].size - used_ < count) {
      ++block_;
      used_ = 0;
    }
    if (block_ == blocks_.size()) {
      const std::size_t size = std::max(count, kBlockSize);
      blocks_.push_back({std::make_unique_for_overwrite<SplitEvent[]>(size), size});
    }
    SplitEvent* const memory = blocks_[block_].memory.get() + used_;
    used_ += count;
    return memory;
  }

 private:
  static constexpr std::size_t kBlockSize = std::size_t{1} << 16;    // 512 KiB
  static constexpr std::size_t kLargestKept = std::size_t{1} << 20;  // 8 MiB
  struct Block {
    std::unique_ptr<SplitEvent[]> memory;
    std::size_t size = 0;
  };
  std::vector<Block> blocks_;
  std::size_t block_ = 0;  // in which the next allocation is tried
  std::size_t used_ = 0;   // events used of it
};

}  // namespace sheaf
