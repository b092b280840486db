// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/channel.h"

#include <algorithm>
#include <bit>

namespace sheaf {
namespace {

bool is_column(DramCommand command) {
  return command == DramCommand::kRead || command == DramCommand::kWrite;
}

}  // namespace

DramChannel::DramChannel(const DramDevice& device)
    : device_(device),
      banks_(device),
      reads_(device.organization.banks_per_channel(), device.read_queue),
      writes_(device.organization.banks_per_channel(), device.write_queue),
      scheduler_(device_, banks_, reads_, writes_),
      refresh_at_(device.organization.ranks) {
  // Ranks are refreshed in turn, so that they do not all stand still together.
  for (std::uint32_t rank = 0; rank < refresh_at_.size(); ++rank) {
    const Cycles share = Cycles{device.timing.tREFI} * (rank + 1) / refresh_at_.size();
    refresh_at_[rank] = device.refresh ? share : kNever;
  }
  scheduler_.set_refreshes(refresh_at_);
}

void DramChannel::advance(Cycles until, std::vector<DramDone>& done) {
  while (!(until == kNever && is_idle())) {
    const Cycles acceptance = next_acceptance();
    if (num_queued() == 0) skip_idle_refreshes(std::min(until, acceptance));
    if (std::min(choose().at, acceptance) >= until) return;
    step(acceptance, done);
  }
}

void DramChannel::relieve(std::size_t waiting, std::vector<DramDone>& done) {
  while (input_.size() > waiting) {
    const Cycles acceptance = next_acceptance();
    if (num_queued() == 0) skip_idle_refreshes(acceptance);
    step(acceptance, done);
  }
}

// With empty queues. Refreshes are all that happens between requests that are far apart, a thousand
// a millisecond: too many to go through one by one beside a core of 1 MHz. Does at once all but the
// last few before `until`, as they would have been done. Not while someone watches every command.
void DramChannel::skip_idle_refreshes(Cycles until) {
  const Cycles period = device_.timing.tREFI;
  const std::size_t ranks = refresh_at_.size();
  if (!device_.refresh || watcher_ || until == kNever) return;
  if (device_.timing.tRFC > period || period < 2 * ranks) return;  // else they hinder each other
  for (std::uint32_t rank = 0; rank < ranks; ++rank) {
    const Cycles due = refresh_at_[rank];
    if (until < due + 3 * period || due < row_bus_at_ || banks_.num_open(rank) != 0 ||
        due < banks_.earliest_refresh(rank)) {
      return;
    }
  }
  Cycles last = 0;
  for (std::uint32_t rank = 0; rank < ranks; ++rank) {
    const Cycles count = (until - refresh_at_[rank]) / period - 1;
    refresh_at_[rank] += count * period;
    banks_.refresh(rank, refresh_at_[rank] - period);
    last = std::max(last, refresh_at_[rank] - period);
    stats_.refresh_cycles += count * device_.timing.tRFC;
    stats_.num_refreshes += count;
  }
  scheduler_.touch_all();
  choice_valid_ = false;
  now_ = last;
  row_bus_at_ = last + 1;
  if (!device_.separate_row_bus) column_bus_at_ = last + 1;
}

// The next command or acceptance.
void DramChannel::step(Cycles acceptance, std::vector<DramDone>& done) {
  const Choice& choice = choose();
  // A request goes into the queue before a command for which it may be considered.
  if (acceptance != kNever && acceptance + device_.controller_latency <= choice.at) {
    accept(acceptance, done);
  } else {
    issue(Choice(choice), done);
  }
}

Cycles DramChannel::next_event() {
  // Refreshes alone wake no one: advance() catches up on them.
  if (num_queued() == 0) return next_acceptance();
  return std::min(choose().at, next_acceptance());
}

// When the first waiting request can be taken; kNever while its queue is full.
Cycles DramChannel::next_acceptance() const {
  if (input_.empty()) return kNever;
  const DramRequest& first = input_.front();
  if ((first.write ? writes_ : reads_).full()) return kNever;
  return std::max(first.arrival, now_);
}

void DramChannel::accept(Cycles now, std::vector<DramDone>& done) {
  count_occupancy(now);
  now_ = now;
  const DramRequest request = input_.front();
  input_.pop_front();
  if (writes_.busy_banks() != 0) {
    const bool queued = writes_.find_same(request) != BankLists::kNone;
    if (queued) {
      ++(request.write ? stats_.num_merged : stats_.num_forwarded);
      // The answer takes the way of data from an open row.
      const DramTiming& t = device_.timing;
      done.push_back({request.tag, now, now + device_.controller_latency + t.tCL + t.tBL});
      return;
    }
  }
  ++(request.write ? stats_.num_writes : stats_.num_reads);
  (request.write ? writes_ : reads_).push(request, now, num_accepted_++);
  scheduler_.touch(request.bank);
  choice_valid_ = choice_valid_ && scheduler_.remains_best(choice_, request);
  stats_.max_queued = std::max<std::uint64_t>(stats_.max_queued, num_queued());
}

void DramChannel::count_occupancy(Cycles now) {
  stats_.queue_occupancy_cycles += num_queued() * (now - counted_until_);
  counted_until_ = now;
}

const DramChannel::Choice& DramChannel::choose() {
  if (!choice_valid_) {
    // A change of direction can make a command due that could have been issued long ago.
    choice_ = scheduler_.choose(buses());
    consider_refreshes(choice_);
    choice_valid_ = true;
  }
  return choice_;
}

void DramChannel::consider_refreshes(Choice& best) const {
  for (std::uint32_t rank = 0; rank < refresh_at_.size(); ++rank) {
    const Cycles due = std::max(refresh_at_[rank], row_bus_at_);
    if (refresh_at_[rank] == kNever || due > best.at) continue;
    const bool open = banks_.num_open(rank) != 0;
    const Cycles ready = open ? banks_.earliest_precharge_all(rank) : banks_.earliest_refresh(rank);
    const Cycles at = std::max(due, ready);
    if (at > best.at) continue;
    best = {.at = at,
            .command = open ? DramCommand::kPrechargeAll : DramCommand::kRefresh,
            .bank = rank,
            .entry = BankLists::kNone};
  }
}

void DramChannel::report(const Choice& choice, DramCommand command) {
  if (!watcher_) return;
  const DramOrganization& o = device_.organization;
  IssuedCommand issued{.at = choice.at, .command = command};
  if (command == DramCommand::kPrechargeAll || command == DramCommand::kRefresh) {
    issued.rank = choice.bank;
  } else {
    issued.rank = choice.bank / o.banks_per_rank();
    issued.bank_group = choice.bank / o.banks % o.bank_groups;
    issued.bank = choice.bank % o.banks;
    issued.row = banks_.bank(choice.bank).row;
  }
  watcher_(issued);
}

void DramChannel::issue(const Choice& choice, std::vector<DramDone>& done) {
  now_ = choice.at;
  choice_valid_ = false;
  if (is_column(choice.command)) {
    column_bus_at_ = now_ + 1;
    if (!device_.separate_row_bus) row_bus_at_ = now_ + 1;
    issue_column(choice, done);
    return;
  }
  row_bus_at_ = now_ + 1;
  if (!device_.separate_row_bus) column_bus_at_ = now_ + 1;
  switch (choice.command) {
    case DramCommand::kActivate:
      scheduler_.touch(choice.bank);
      scheduler_.row_opened(choice.bank);
      banks_.activate(banks_.bank(choice.bank), queue()[choice.entry].request.row, now_);
      ++stats_.num_activates;
      break;
    case DramCommand::kPrecharge:
      scheduler_.touch(choice.bank);
      banks_.precharge(banks_.bank(choice.bank), now_);
      banks_.bank(choice.bank).had_conflict = true;
      ++stats_.num_precharges;
      break;
    case DramCommand::kPrechargeAll:
      scheduler_.touch_all();
      stats_.num_precharges += banks_.precharge_all(choice.bank, now_);
      break;
    default:
      scheduler_.touch_all();
      banks_.refresh(choice.bank, now_);
      refresh_at_[choice.bank] += device_.timing.tREFI;
      scheduler_.set_refreshes(refresh_at_);
      stats_.refresh_cycles += device_.timing.tRFC;
      ++stats_.num_refreshes;
  }
  report(choice, choice.command);
}

void DramChannel::issue_column(const Choice& choice, std::vector<DramDone>& done) {
  BankTiming::Bank& bank = banks_.bank(choice.bank);
  BankLists& requests = queue();
  scheduler_.touch(choice.bank);
  BankLists::Entry& entry = requests[choice.entry];
  if (!entry.started) {
    entry.started = true;
    count_outcome(bank);
    const BankLists::Entry& oldest = requests[requests.oldest(choice.bank)];
    if (oldest.request.row != bank.row) scheduler_.count_overtaken(choice.bank);
  }
  const bool write = entry.request.write;
  if (moved_data_ && write != wrote_last_) ++stats_.num_turnarounds;
  moved_data_ = true;
  wrote_last_ = write;
  write ? banks_.write(bank, now_) : banks_.read(bank, now_);
  ++(write ? stats_.num_write_bursts : stats_.num_read_bursts);
  stats_.bus_busy_cycles += device_.timing.tBL;
  DramCommand command = choice.command;
  if (--entry.bursts_left == 0) {
    const Cycles latency = write ? device_.timing.tCWL : device_.timing.tCL;
    done.push_back({entry.request.tag, entry.accepted, now_ + latency + device_.timing.tBL});
    stats_.sum_queue_residence += now_ - entry.accepted;
    count_occupancy(now_);
    requests.erase(choice.entry);
    if (device_.page == PagePolicy::kClosed &&
        reads_.find_row(choice.bank, bank.row) == BankLists::kNone &&
        writes_.find_row(choice.bank, bank.row) == BankLists::kNone) {
      banks_.auto_precharge(bank);
      ++stats_.num_precharges;
      command = write ? DramCommand::kWritePrecharge : DramCommand::kReadPrecharge;
    }
  }
  report(choice, command);
}

// Whether a request's row was open, to be opened, or another one in its way.
void DramChannel::count_outcome(BankTiming::Bank& bank) {
  if (!bank.fresh) {
    ++stats_.num_row_hits;
  } else if (bank.had_conflict) {
    ++stats_.num_row_conflicts;
  } else {
    ++stats_.num_row_misses;
  }
  bank.fresh = false;
}

DramChannelStats DramChannel::stats(Cycles end) const {
  DramChannelStats stats = stats_;
  stats.active_cycles = banks_.active_cycles(end);
  stats.queue_occupancy_cycles += num_queued() * (end - counted_until_);
  return stats;
}

}  // namespace sheaf
