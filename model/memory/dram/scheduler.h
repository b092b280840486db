// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  /// The best command that is issued no earlier than `row_bus` or `column_bus`, by its bus.
  /// Commands at or after refresh_at[rank] are not considered.
  [[nodiscard]] Choice choose(Cycles row_bus, Cycles column_bus,
                              const std::vector<Cycles>& refresh_at);

  /// The bank or its requests have changed.
  void touch(std::uint32_t bank) { stale_ |= std::uint64_t{1} << bank; }
  void touch_all() { stale_ = ~std::uint64_t{0}; }
  /// A request of `bank` was served although an older one waits for another row.
  void count_overtaken(std::uint32_t bank) { ++overtaken_[bank]; }
  void row_opened(std::uint32_t bank) { overtaken_[bank] = 0; }

  [[nodiscard]] bool writing() const { return writing_; }

 private:
  // Numbers of the kinds of candidates, which index the limits.
  enum Kind : std::uint8_t { kColumn, kActivate, kPrecharge };
  struct Candidate {
    Cycles ready = 0;  ///< as far as bank and request go
    std::uint64_t age = 0;
    BankLists::Index entry = BankLists::kNone;
    Kind kind{};
    std::uint8_t group = 0;
    std::uint8_t rank = 0;
  };
  void choose_direction();
  void renew(std::uint32_t bank);
  void set_limits(Cycles row_bus, Cycles column_bus);
  [[nodiscard]] const BankLists& queue() const { return writing_ ? writes_ : reads_; }

  const DramDevice& device_;
  const BankTiming& banks_;
  const BankLists& reads_;
  const BankLists& writes_;
  std::vector<Candidate> candidates_;     ///< a bank
  std::vector<std::uint32_t> overtaken_;  ///< a bank: row hits that went before an older request
  std::array<std::vector<Cycles>, 3> limits_;  ///< a kind, a group: earliest for all its banks
  std::uint64_t stale_ = ~std::uint64_t{0};
  bool writing_ = false;   ///< whose requests are served now
  bool draining_ = false;  ///< writes go first until few are left
};

}  // namespace sheaf
