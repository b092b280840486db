// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/dram_system.h"

#include <algorithm>

namespace sheaf {

DramSystem::DramSystem(const DramDevice& device) : device_(device) {
  for (std::uint32_t i = 0; i < device.organization.channels; ++i) {
    channels_.push_back(std::make_unique<DramChannel>(device_));
  }
}

void DramSystem::push(const Request& request) {
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint32_t>(pending_.size()));
    pending_.emplace_back();
  }
  const std::uint32_t tag = free_.back();
  free_.pop_back();
  Pending& pending = pending_[tag];
  pending = {{request.id, request.user, request.write, request.arrival, kNever, 0}, 0};

  const DramOrganization& o = device_.organization;
  const unsigned shift = device_.map.byte_bits();
  const std::uint64_t run = device_.map.bursts_in_a_run();
  std::uint64_t burst = request.address >> shift;
  const std::uint64_t last = (request.address + request.bytes - 1) >> shift;
  while (burst <= last) {
    const std::uint64_t end = std::min(last + 1, (burst / run + 1) * run);
    const DramLocation where = device_.map.locate(burst << shift);
    const std::uint32_t bank =
        (where.rank * o.bank_groups + where.bank_group) * o.banks + where.bank;
    channels_[where.channel]->push({.arrival = request.arrival,
                                    .tag = tag,
                                    .bank = bank,
                                    .row = where.row,
                                    .column = where.column,
                                    .bursts = static_cast<std::uint32_t>(end - burst),
                                    .write = request.write});
    ++pending.parts_left;
    burst = end;
  }
}

Cycles DramSystem::next_event() const {
  Cycles next = kNever;
  for (const auto& channel : channels_) next = std::min(next, channel->next_event());
  return next;
}

std::size_t DramSystem::num_waiting() const {
  std::size_t most = 0;
  for (const auto& channel : channels_) most = std::max(most, channel->num_waiting());
  return most;
}

Cycles DramSystem::now() const {
  Cycles now = 0;
  for (const auto& channel : channels_) now = std::max(now, channel->now());
  return now;
}

DramChannelStats DramSystem::stats(Cycles end) const {
  DramChannelStats sum;
  for (const auto& channel : channels_) {
    const DramChannelStats one = channel->stats(end);
    const std::uint64_t most = std::max(sum.max_queued, one.max_queued);
    sum += one;
    sum.max_queued = most;
  }
  return sum;
}

}  // namespace sheaf
