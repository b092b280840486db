// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sheaf {

/// Things in the order of their last use, by time stamp: a bit is set at the stamp of each thing's
/// last use, so that the number of things used later than one is the number of bits behind its own.
/// (B. T. Bennett and V. J. Kruskal, "LRU stack processing", IBM J. Res. Dev. 19(4), 1975.) The
/// bits are counted in blocks of 512, and a binary indexed tree sums the blocks (P. M. Fenwick, "A
/// new data structure for cumulative frequency tables", Softw. Pract. Exper. 24(3), 1994), so that
/// what is looked at stays small enough for a processor's caches: a bit a stamp, 4 bytes a block.
///
/// When its stamps are used up the owner renumbers: stamps() before, reset() with room for more.
class RecencyOrder {
 public:
  using Stamp = std::uint32_t;

  [[nodiscard]] bool is_full() const { return next_ == things_.size(); }
  [[nodiscard]] std::uint32_t num_live() const { return num_live_; }
  /// The stamp that push() will give, less one: of what was used last, if anything was.
  [[nodiscard]] Stamp last() const { return next_ - 1; }

  /// Takes a thing in as the one used last. Must not be full.
  Stamp push(std::uint32_t thing) {
    things_[next_] = thing;
    words_[next_ / 64] |= std::uint64_t{1} << (next_ % 64);
    ++num_live_;
    ++num_open_;
    const Stamp stamp = next_++;
    if (next_ % kBlock == 0) close_block(stamp / kBlock);
    return stamp;
  }

  /// Takes the thing of this stamp out, and returns how many were used later.
  std::uint32_t pull(Stamp stamp) {
    const std::uint32_t block = stamp / kBlock;
    const std::uint32_t in_block = count_up_to(stamp);
    words_[stamp / 64] &= ~(std::uint64_t{1} << (stamp % 64));
    if (block == next_ / kBlock) {
      const std::uint32_t later = num_open_ - in_block;
      --num_open_;
      --num_live_;
      return later;
    }
    const std::uint32_t later = num_live_ - sum_before(block) - in_block;
    for (std::uint32_t i = block + 1; i < sums_.size(); i += i & -i) --sums_[i];
    --num_live_;
    return later;
  }

  /// Where the thing of a stamp is kept has changed.
  void rename(Stamp stamp, std::uint32_t thing) { things_[stamp] = thing; }

  /// Gives all things new stamps from 0, in order, with room for as many uses again as there are
  /// things; calls f(thing, stamp) for each.
  template <typename F>
  void renumber(F&& f) {
    std::vector<std::uint32_t> live;
    live.reserve(num_live_);
    for (std::size_t word = 0; word < words_.size(); ++word) {
      for (std::uint64_t left = words_[word]; left != 0; left &= left - 1) {
        live.push_back(things_[word * 64 + static_cast<std::size_t>(std::countr_zero(left))]);
      }
    }
    const std::size_t capacity = std::bit_ceil(std::max<std::size_t>(live.size() * 2, 8));
    things_.assign(capacity, 0);
    words_.assign((capacity + 63) / 64, 0);
    sums_.assign(capacity / kBlock + 1, 0);
    next_ = num_live_ = num_open_ = 0;
    for (const std::uint32_t thing : live) f(thing, push(thing));
  }

 private:
  static constexpr std::uint32_t kBlock = 512;

  // Bits of the stamp's block up to the stamp.
  [[nodiscard]] std::uint32_t count_up_to(Stamp stamp) const {
    const std::uint64_t* word = words_.data() + std::size_t{stamp / kBlock} * (kBlock / 64);
    const std::uint64_t* const last = words_.data() + stamp / 64;
    int count = std::popcount(*last << (63 - stamp % 64));
    for (; word != last; ++word) count += std::popcount(*word);
    return static_cast<std::uint32_t>(count);
  }
  // Bits of the blocks before this one, all of which are closed.
  [[nodiscard]] std::uint32_t sum_before(std::uint32_t block) const {
    std::uint32_t sum = 0;
    for (std::uint32_t i = block; i != 0; i &= i - 1) sum += sums_[i];
    return sum;
  }
  void close_block(std::uint32_t block) {
    for (std::uint32_t i = block + 1; i < sums_.size(); i += i & -i) sums_[i] += num_open_;
    num_open_ = 0;
  }

  std::vector<std::uint32_t> things_;  ///< by stamp
  std::vector<std::uint64_t> words_;   ///< bit of a stamp: its thing has not been used later
  std::vector<std::uint32_t> sums_;    ///< binary indexed tree over closed blocks, from 1
  std::uint32_t next_ = 0;
  std::uint32_t num_live_ = 0;
  std::uint32_t num_open_ = 0;  ///< bits in the block that next_ lies in
};

}  // namespace sheaf
