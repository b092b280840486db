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
      candidates_(banks.num_banks()),
      overtaken_(banks.num_banks()) {
  for (std::vector<Cycles>& limits : limits_) limits.resize(banks.num_groups());
}

void DramScheduler::choose_direction() {
  draining_ = writes_.size() >= (draining_ ? device_.write_low + 1 : device_.write_high);
  const bool writing = writes_.size() != 0 && (draining_ || reads_.size() == 0);
  if (writing != writing_) touch_all();
  writing_ = writing;
}

void DramScheduler::renew(std::uint32_t index) {
  const BankTiming::Bank& bank = banks_.bank(index);
  const BankLists& requests = queue();
  Candidate& candidate = candidates_[index];
  BankLists::Index entry = requests.oldest(index);
  candidate.rank = static_cast<std::uint8_t>(bank.rank);
  candidate.group = static_cast<std::uint8_t>(bank.group);
  candidate.kind = kColumn;
  candidate.ready = writing_ ? bank.write_at : bank.read_at;
  if (!bank.open) {
    candidate.kind = kActivate;
    candidate.ready = bank.activate_at;
  } else if (requests[entry].request.row != bank.row) {
    const BankLists::Index hit = requests.find_row(index, bank.row);
    const bool may_overtake = device_.row_hit_cap == 0 || overtaken_[index] < device_.row_hit_cap;
    if (hit != BankLists::kNone && (may_overtake || requests[hit].started)) {
      entry = hit;
    } else {
      candidate.kind = kPrecharge;
      candidate.ready = bank.precharge_at;
    }
  }
  candidate.entry = entry;
  candidate.age = requests[entry].age;
  candidate.ready =
      std::max(candidate.ready, requests[entry].accepted + device_.controller_latency);
}

void DramScheduler::set_limits(Cycles row_bus, Cycles column_bus) {
  for (std::uint32_t group = 0; group < banks_.num_groups(); ++group) {
    const Cycles column = writing_ ? banks_.group_write_at(group) : banks_.group_read_at(group);
    limits_[kColumn][group] = std::max(column, column_bus);
    limits_[kActivate][group] = std::max(banks_.group_activate_at(group), row_bus);
    limits_[kPrecharge][group] = row_bus;
  }
}

DramScheduler::Choice DramScheduler::choose(Cycles row_bus, Cycles column_bus,
                                            const std::vector<Cycles>& refresh_at) {
  choose_direction();
  const std::uint64_t busy = queue().busy_banks();
  for (std::uint64_t stale = stale_ & busy; stale != 0; stale &= stale - 1) {
    renew(static_cast<std::uint32_t>(std::countr_zero(stale)));
  }
  stale_ &= ~busy;
  set_limits(row_bus, column_bus);
  // Twice the time, plus one for a row command, orders by time and then by kind.
  std::uint64_t best_order = kNever;
  std::uint64_t best_age = 0;
  std::uint32_t best_bank = 0;
  for (std::uint64_t rest = busy; rest != 0; rest &= rest - 1) {
    const auto index = static_cast<std::uint32_t>(std::countr_zero(rest));
    const Candidate& candidate = candidates_[index];
    const Cycles at = std::max(candidate.ready, limits_[candidate.kind][candidate.group]);
    const std::uint64_t order = 2 * at + (candidate.kind == kColumn ? 0 : 1);
    if (order > best_order || (order == best_order && candidate.age > best_age)) continue;
    if (at >= refresh_at[candidate.rank]) continue;
    best_order = order;
    best_age = candidate.age;
    best_bank = index;
  }
  if (best_order == kNever) return {};
  const Candidate& best = candidates_[best_bank];
  Choice choice{best_order / 2, DramCommand::kPrecharge, best_bank, best.entry};
  if (best.kind == kActivate) choice.command = DramCommand::kActivate;
  if (best.kind == kColumn) choice.command = writing_ ? DramCommand::kWrite : DramCommand::kRead;
  return choice;
}

}  // namespace sheaf
