// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/replay_chain.h"

namespace sheaf {

void ChainReader::read_until(Cycles recorded, const OnChain& on_chain) {
  look_ahead();
  while (next_epoch_ != kNoEpoch && records_.peek()->cycle <= recorded) read_step(on_chain);
}

// A chain that takes longer than when it was recorded is read further than others.
bool ChainReader::has_step(const ReplayChain& chain, const OnChain& on_chain) {
  while (chain.next == chain.steps.size() && read_step(on_chain)) {
  }
  return chain.next != chain.steps.size();
}

bool ChainReader::read_step(const OnChain& on_chain) {
  const MemoryRecord* record = records_.peek();
  if (record == nullptr) return false;
  ReplayChain*& open = open_[record->context];
  if (record->begins != (open == nullptr)) records_.refuse("a chain begins within another");
  if (open == nullptr) {
    open = pool_.acquire();
    open->start = records_.chain();
    open->stream = stream_;
    open->steps.clear();
    open->next = 0;
  }
  ReplayChain& chain = *open;
  const bool begins = record->begins;
  do {
    chain.steps.push_back({*record, records_.number()});
    ++num_held_;
    if (record->ends) open = nullptr;
    records_.pop();
    record = records_.peek();
  } while (record != nullptr && record->continues);
  if (begins) on_chain(chain);
  look_ahead();
  return true;
}

void ChainReader::look_ahead() {
  const MemoryRecord* record = records_.peek();
  if (record == nullptr) {
    next_epoch_ = kNoEpoch;
  } else if (record->begins) {
    next_epoch_ = records_.chain().epoch;
  }
}

}  // namespace sheaf
