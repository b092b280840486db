// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/units.h"
#include "config/dram/device.h"
#include "memory/dram/bank_timing.h"
#include "memory/dram/commands.h"
#include "memory/dram/request_queue.h"

namespace sheaf {

/// Chooses a channel's next command: first-ready, first-come-first-served (Rixner et al., "Memory
/// access scheduling", ISCA 2000), reads before writes until writes have to be drained.
///
/// Each bank with requests of the direction that is served has one candidate: a column command for
/// the oldest request that meets its row open; else the row's opening for the oldest request; else
/// a precharge. It changes only when the bank or its requests do, so it is kept until the channel
/// says so by touch(). Of the candidates the one that may go first is chosen; of the same cycle a
/// column command before a row command, then the older request.
class DramScheduler {
 public:
  DramScheduler(const DramDevice& device, const BankTiming& banks, const BankLists& reads,
                const BankLists& writes);

  struct Choice {
    Cycles at = kNever;
    DramCommand command{};
    std::uint32_t bank = 0;  ///< or rank, of kPrechargeAll and kRefresh
    BankLists::Index entry = BankLists::kNone;
  };
  /// First free cycle of the command buses.
  struct Buses {
    Cycles row = 0, column = 0;
  };
  /// The best command that is issued no earlier than its bus is free.
  [[nodiscard]] Choice choose(const Buses& buses);
  /// Whether a choice is still the best one after a request has joined its bank's others, with
  /// nothing else changed. False may also mean: not sure.
  [[nodiscard]] bool remains_best(const Choice& choice, const DramRequest& joined);

  /// Commands at or after refresh_at[rank] are not considered from now on.
  void set_refreshes(const std::vector<Cycles>& refresh_at) { refresh_at_ = refresh_at; }
  /// The bank or its requests have changed.
  void touch(std::uint32_t bank) { stale_ |= std::uint64_t{1} << bank; }
  void touch_all() { stale_ = all_banks_; }
  /// A request of `bank` was served although an older one waits for another row.
  void count_overtaken(std::uint32_t bank) { ++overtaken_[bank]; }
  void row_opened(std::uint32_t bank) { overtaken_[bank] = 0; }

  [[nodiscard]] bool writing() const { return writing_; }

 private:
  // Numbers of the kinds of candidates, which index the limits.
  enum Kind : std::uint8_t { kColumn, kActivate, kPrecharge };
  static constexpr std::uint32_t kNumKinds = 3;
  static constexpr std::uint32_t kMostBanks = 64;

  // Twice the time, plus one for a row command, orders by time and then by kind; with the age
  // behind it the lowest is the one to be issued. Kept apart by what the choice looks at, so that
  // it runs over banks without a branch.
  __extension__ using Order = unsigned __int128;
  struct Candidates {
    std::array<std::uint64_t, kMostBanks> ready;  ///< as far as bank and request go
    std::array<std::uint64_t, kMostBanks> age_and_bank;
    std::array<std::uint32_t, kMostBanks> limit;  ///< index into from_
    std::array<BankLists::Index, kMostBanks> entry;
  };
  void choose_direction();
  void renew(std::uint32_t index);
  void set_limits(const Buses& buses);
  [[nodiscard]] std::uint64_t order_of(std::uint32_t bank) const {
    return std::max(candidates_.ready[bank], from_[candidates_.limit[bank]]);
  }
  [[nodiscard]] bool is_allowed(std::uint32_t bank, std::uint64_t order) const {
    return order / 2 < refresh_at_[banks_.bank(bank).rank];
  }
  [[nodiscard]] std::uint64_t banks_of_rank(std::uint32_t rank) const {
    const std::uint32_t banks = device_.organization.banks_per_rank();
    return all_banks_ >> (num_banks_ - banks) << (rank * banks);
  }
  [[nodiscard]] Order first_of(std::uint64_t banks) const;
  [[nodiscard]] Choice choice_of(std::uint32_t bank, std::uint64_t order) const;
  [[nodiscard]] const BankLists& queue() const { return writing_ ? writes_ : reads_; }

  const DramDevice& device_;
  const BankTiming& banks_;
  const BankLists& reads_;
  const BankLists& writes_;
  const std::uint32_t num_banks_, num_groups_;
  Candidates candidates_{};               ///< of banks with requests
  std::vector<std::uint32_t> overtaken_;  ///< a bank: row hits that went before an older request
  /// A kind, a group: for all its banks; kPrecharge: for all banks.
  std::array<std::uint64_t, std::size_t{kNumKinds} * kMostBanks> from_{};
  std::vector<Cycles> refresh_at_;
  const std::uint64_t all_banks_;
  std::uint64_t stale_ = 0;  ///< bit i: bank i or its requests have changed
  bool writing_ = false;     ///< whose requests are served now
  bool draining_ = false;    ///< writes go first until few are left
};

}  // namespace sheaf
