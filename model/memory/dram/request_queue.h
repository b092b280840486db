// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/units.h"

namespace sheaf {

/// Bursts of one row that a channel has been asked for.
struct DramRequest {
  Cycles arrival = 0;  ///< tCK
  std::uint32_t tag = 0;
  std::uint32_t bank = 0;  ///< in the channel: (rank x groups + group) x banks + bank
  std::uint32_t row = 0;
  std::uint32_t column = 0;  ///< of the first burst
  std::uint32_t bursts = 1;
  bool write = false;
};

/// Queued requests of one direction, as one list a bank in order of age. Entries are named by a
/// number that stays theirs while they are queued.
class BankLists {
 public:
  using Index = std::uint32_t;
  static constexpr Index kNone = ~Index{0};

  struct Entry {
    DramRequest request;
    Cycles accepted = 0;
    std::uint64_t age = 0;  ///< number of acceptance: the lower the older
    std::uint32_t bursts_left = 0;
    bool started = false;  ///< its first column command has been issued
    Index next = kNone, previous = kNone;
  };

  BankLists(std::uint32_t banks, std::uint32_t capacity)
      : heads_(banks, kNone), tails_(banks, kNone), entries_(capacity) {
    for (Index i = capacity; i-- > 0;) free_.push_back(i);
  }

  [[nodiscard]] bool full() const { return free_.empty(); }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Index oldest(std::uint32_t bank) const { return heads_[bank]; }
  [[nodiscard]] Entry& operator[](Index index) { return entries_[index]; }
  [[nodiscard]] const Entry& operator[](Index index) const { return entries_[index]; }
  /// Bit i: bank i has entries.
  [[nodiscard]] std::uint64_t busy_banks() const { return busy_banks_; }

  /// The oldest entry of the bank for this row, or kNone.
  [[nodiscard]] Index find_row(std::uint32_t bank, std::uint32_t row) const {
    Index i = heads_[bank];
    while (i != kNone && entries_[i].request.row != row) i = entries_[i].next;
    return i;
  }
  /// The entry for the same bursts, or kNone.
  [[nodiscard]] Index find_same(const DramRequest& wanted) const {
    for (Index i = heads_[wanted.bank]; i != kNone; i = entries_[i].next) {
      const DramRequest& queued = entries_[i].request;
      if (queued.row == wanted.row && queued.column == wanted.column &&
          queued.bursts >= wanted.bursts) {
        return i;
      }
    }
    return kNone;
  }

  void push(const DramRequest& request, Cycles now, std::uint64_t age) {
    const Index i = free_.back();
    free_.pop_back();
    ++size_;
    const Index tail = tails_[request.bank];
    entries_[i] = {request, now, age, request.bursts, false, kNone, tail};
    (tail == kNone ? heads_[request.bank] : entries_[tail].next) = i;
    tails_[request.bank] = i;
    busy_banks_ |= std::uint64_t{1} << request.bank;
  }
  void erase(Index i) {
    const Entry& entry = entries_[i];
    const std::uint32_t bank = entry.request.bank;
    (entry.previous == kNone ? heads_[bank] : entries_[entry.previous].next) = entry.next;
    (entry.next == kNone ? tails_[bank] : entries_[entry.next].previous) = entry.previous;
    if (heads_[bank] == kNone) busy_banks_ &= ~(std::uint64_t{1} << bank);
    free_.push_back(i);
    --size_;
  }

 private:
  std::vector<Index> heads_, tails_;
  std::vector<Entry> entries_;
  std::vector<Index> free_;
  std::size_t size_ = 0;
  std::uint64_t busy_banks_ = 0;
};

}  // namespace sheaf
