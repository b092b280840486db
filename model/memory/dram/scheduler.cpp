// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/scheduler.h"

#include <algorithm>
#include <bit>

namespace sheaf {

DramScheduler::DramScheduler(const DramDevice& device, const BankTiming& banks,
                             const BankLists& reads, const BankLists& writes)
    : device_(device),
      banks_(banks),
      reads_(reads),
      writes_(writes),
      num_banks_(banks.num_banks()),
      num_groups_(banks.num_groups()),
      overtaken_(banks.num_banks()),
      all_banks_(~std::uint64_t{0} >> (kMostBanks - num_banks_)) {}

void DramScheduler::choose_direction() {
  draining_ = writes_.size() >= (draining_ ? device_.write_low + 1 : device_.write_high);
  const bool writing = writes_.size() != 0 && (draining_ || reads_.size() == 0);
  if (writing == writing_) return;
  touch_all();
  writing_ = writing;
}

void DramScheduler::renew(std::uint32_t index) {
  const BankTiming::Bank& bank = banks_.bank(index);
  const BankLists& requests = queue();
  BankLists::Index entry = requests.oldest(index);
  if (entry == BankLists::kNone) return;
  Kind kind = kColumn;
  Cycles ready = writing_ ? bank.write_at : bank.read_at;
  if (!bank.open) {
    kind = kActivate;
    ready = bank.activate_at;
  } else if (requests[entry].request.row != bank.row) {
    const BankLists::Index hit = requests.find_row(index, bank.row);
    const bool may_overtake = device_.row_hit_cap == 0 || overtaken_[index] < device_.row_hit_cap;
    if (hit != BankLists::kNone && (may_overtake || requests[hit].started)) {
      entry = hit;
    } else {
      kind = kPrecharge;
      ready = bank.precharge_at;
    }
  }
  ready = std::max(ready, requests[entry].accepted + device_.controller_latency);
  candidates_.ready[index] = 2 * ready + (kind == kColumn ? 0 : 1);
  candidates_.age_and_bank[index] = requests[entry].age * kMostBanks + index;
  candidates_.limit[index] = kind * num_groups_ + (kind == kPrecharge ? 0 : bank.group);
  candidates_.entry[index] = entry;
}

void DramScheduler::set_limits(const Buses& buses) {
  std::uint64_t* const column = from_.data() + std::size_t{kColumn} * num_groups_;
  std::uint64_t* const activate = from_.data() + std::size_t{kActivate} * num_groups_;
  const std::uint32_t groups_per_rank = device_.organization.bank_groups;
  std::uint32_t group = 0;
  for (std::uint32_t rank = 0; group < num_groups_; ++rank) {
    const Cycles column_at = std::max(banks_.rank_column_at(rank, writing_), buses.column);
    const Cycles activate_at = std::max(banks_.rank_activate_at(rank), buses.row);
    for (const std::uint32_t end = group + groups_per_rank; group < end; ++group) {
      column[group] = 2 * std::max(banks_.group_column_at(group, writing_), column_at);
      activate[group] = 2 * std::max(banks_.group_activate_at(group), activate_at) + 1;
    }
  }
  from_[std::size_t{kPrecharge} * num_groups_] = 2 * buses.row + 1;
}

DramScheduler::Choice DramScheduler::choose(const Buses& buses) {
  choose_direction();
  for (; stale_ != 0; stale_ &= stale_ - 1) {
    renew(static_cast<std::uint32_t>(std::countr_zero(stale_)));
  }
  set_limits(buses);
  for (std::uint64_t banks = queue().busy_banks(); banks != 0;) {
    const Order first = first_of(banks);
    const auto order = static_cast<std::uint64_t>(first >> 64);
    const auto bank = static_cast<std::uint32_t>(first % kMostBanks);
    if (is_allowed(bank, order)) return choice_of(bank, order);
    banks &= ~banks_of_rank(banks_.bank(bank).rank);
  }
  return {};
}

// Of the candidates of these banks. Which of two is better is as good as random, so that a branch
// on it would be slow.
DramScheduler::Order DramScheduler::first_of(std::uint64_t banks) const {
  Order first = ~Order{0};
  for (; banks != 0; banks &= banks - 1) {
    const auto bank = static_cast<std::uint32_t>(std::countr_zero(banks));
    first = std::min(first, Order{order_of(bank)} << 64 | candidates_.age_and_bank[bank]);
  }
  return first;
}

bool DramScheduler::remains_best(const Choice& choice, const DramRequest& joined) {
  const bool was_writing = writing_;
  choose_direction();
  if (writing_ != was_writing || stale_ != std::uint64_t{1} << joined.bank) return false;
  if (joined.write != writing_) return true;
  const std::uint64_t ready = candidates_.ready[joined.bank];
  const BankLists::Index entry = candidates_.entry[joined.bank];
  renew(joined.bank);
  stale_ = 0;
  // What an empty bank has for a candidate is that of a request long served.
  const bool had_others = queue()[queue().oldest(joined.bank)].next != BankLists::kNone;
  if (had_others && candidates_.ready[joined.bank] == ready &&
      candidates_.entry[joined.bank] == entry) {
    return true;
  }
  const bool of_that_bank = choice.entry != BankLists::kNone && choice.bank == joined.bank;
  return !of_that_bank && order_of(joined.bank) / 2 > choice.at;
}

DramScheduler::Choice DramScheduler::choice_of(std::uint32_t bank, std::uint64_t order) const {
  Choice choice{order / 2, DramCommand::kPrecharge, bank, candidates_.entry[bank]};
  const std::uint32_t kind = candidates_.limit[bank] / num_groups_;
  if (kind == kActivate) choice.command = DramCommand::kActivate;
  if (kind == kColumn) choice.command = writing_ ? DramCommand::kWrite : DramCommand::kRead;
  return choice;
}

}  // namespace sheaf
