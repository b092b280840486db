// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/bank_timing.h"

namespace sheaf {
namespace {

void delay(Cycles& earliest, Cycles until) {
  earliest = std::max(earliest, until);
}

// a - b, but at least one cycle.
Cycles gap(Cycles a, Cycles b) {
  return a > b ? a - b : 1;
}

}  // namespace

BankTiming::BankTiming(const DramDevice& device)
    : t_(device.timing),
      banks_per_rank_(device.organization.banks_per_rank()),
      banks_(device.organization.banks_per_channel()),
      groups_(std::size_t{device.organization.ranks} * device.organization.bank_groups),
      ranks_(device.organization.ranks) {
  for (std::uint32_t i = 0; i < banks_.size(); ++i) {
    banks_[i].rank = i / banks_per_rank_;
    banks_[i].group = i / device.organization.banks;
  }
}

Cycles BankTiming::earliest_precharge_all(std::uint32_t rank) const {
  Cycles at = 0;
  for (std::uint32_t i = rank * banks_per_rank_; i < (rank + 1) * banks_per_rank_; ++i) {
    delay(at, banks_[i].precharge_at);  // also of those that are closing by themselves
  }
  return at;
}

Cycles BankTiming::earliest_refresh(std::uint32_t rank) const {
  Cycles at = 0;
  for (std::uint32_t i = rank * banks_per_rank_; i < (rank + 1) * banks_per_rank_; ++i) {
    delay(at, banks_[i].activate_at);
  }
  return at;
}

void BankTiming::activate(Bank& bank, std::uint32_t row, Cycles now) {
  bank.open = true;
  bank.fresh = true;
  bank.row = row;
  bank.read_at = now + t_.tRCD;
  bank.write_at = now + t_.tRCDWR;
  bank.precharge_at = now + t_.tRAS;
  bank.activate_at = now + t_.tRC;
  groups_[bank.group].activate_at = now + t_.tRRD_L;
  Rank& rank = ranks_[bank.rank];
  rank.activations[rank.oldest_activation] = now + t_.tFAW;
  rank.oldest_activation = (rank.oldest_activation + 1) % 4;
  rank.activate_at = std::max(now + t_.tRRD_S, rank.activations[rank.oldest_activation]);
  if (rank.num_open++ == 0 && now > rank.active_until) {
    rank.active += rank.active_until - rank.active_since;
    rank.active_since = now;
  }
}

void BankTiming::close(Bank& bank, Cycles at) {
  bank.open = false;
  delay(bank.activate_at, at + t_.tRP);
  Rank& rank = ranks_[bank.rank];
  --rank.num_open;
  delay(rank.active_until, at);
}

void BankTiming::precharge(Bank& bank, Cycles now) {
  close(bank, now);
}

std::uint32_t BankTiming::precharge_all(std::uint32_t rank, Cycles now) {
  std::uint32_t closed = 0;
  for (std::uint32_t i = rank * banks_per_rank_; i < (rank + 1) * banks_per_rank_; ++i) {
    if (!banks_[i].open) continue;
    close(banks_[i], now);
    banks_[i].had_conflict = false;
    ++closed;
  }
  return closed;
}

void BankTiming::read(Bank& bank, Cycles now) {
  delay(bank.precharge_at, now + t_.tRTP);
  delay(groups_[bank.group].read_at, now + t_.tCCD_L);
  for (std::uint32_t i = 0; i < ranks_.size(); ++i) {
    const bool same = i == bank.rank;
    delay(ranks_[i].read_at, now + (same ? t_.tCCD_S : t_.tBL + t_.tRTRS));
    delay(ranks_[i].write_at, now + (same ? t_.tRTW : gap(t_.tCL + t_.tBL + t_.tRTRS, t_.tCWL)));
  }
}

void BankTiming::write(Bank& bank, Cycles now) {
  const Cycles end = now + t_.tCWL + t_.tBL;
  delay(bank.precharge_at, end + t_.tWR);
  Group& group = groups_[bank.group];
  delay(group.write_at, now + t_.tCCD_L);
  delay(group.read_at, end + t_.tWTR_L);
  for (std::uint32_t i = 0; i < ranks_.size(); ++i) {
    const bool same = i == bank.rank;
    delay(ranks_[i].write_at, now + (same ? t_.tCCD_S : t_.tBL + t_.tRTRS));
    delay(ranks_[i].read_at,
          same ? end + t_.tWTR_S : now + gap(t_.tCWL + t_.tBL + t_.tRTRS, t_.tCL));
  }
}

void BankTiming::auto_precharge(Bank& bank) {
  close(bank, bank.precharge_at);
  bank.had_conflict = false;
}

void BankTiming::refresh(std::uint32_t rank, Cycles now) {
  for (std::uint32_t i = rank * banks_per_rank_; i < (rank + 1) * banks_per_rank_; ++i) {
    delay(banks_[i].activate_at, now + t_.tRFC);
  }
}

Cycles BankTiming::active_cycles(Cycles end) const {
  Cycles sum = 0;
  for (const Rank& rank : ranks_) {
    const Cycles until = rank.num_open != 0 ? end : std::min(rank.active_until, end);
    sum += rank.active + (until > rank.active_since ? until - rank.active_since : 0);
  }
  return sum;
}

}  // namespace sheaf
