// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/crossbar.h"

#include <algorithm>

namespace sheaf::clocked {
namespace {

Cycles cycles_of(Bytes bytes, Bytes width) {
  return (bytes + width - 1) / width;
}

}  // namespace

void RequestCrossbar::push(const LineRequest& request, std::size_t bank, Cycles now) {
  if (request.requester >= caches_.size()) caches_.resize(request.requester + 1U);
  caches_[request.requester].queue.push_back({request, bank, now});
  stats_.max_waiting = std::max(stats_.max_waiting, ++num_waiting_);
}

// The cache whose first request goes to this bank now, if any.
RequestCrossbar::Cache* RequestCrossbar::choose(std::size_t bank, Cycles now) {
  Cache* best = nullptr;
  for (Cache& cache : caches_) {
    if (cache.queue.empty() || cache.queue.front().bank != bank || cache.free_at > now) continue;
    const Cycles arrival = cache.queue.front().arrival;
    if (best == nullptr || arrival < best->queue.front().arrival) best = &cache;
  }
  return best;
}

std::vector<LineRequest> RequestCrossbar::cross(const HasRoom& has_room, Cycles now) {
  std::vector<LineRequest> crossing;
  for (std::size_t bank = 0; bank < banks_.size(); ++bank) {
    if (banks_[bank] > now || !has_room(bank)) continue;
    Cache* const cache = choose(bank, now);
    if (cache == nullptr) continue;
    const Entry entry = cache->queue.front();
    cache->queue.pop_front();
    const LineRequest& request = entry.request;
    const Cycles taken = request.write ? cycles_of(request.bytes, spec_.request_width) : 1;
    cache->free_at = banks_[bank] = now + taken;
    crossing.push_back(request);
    --num_waiting_;
    ++stats_.num_requests;
    stats_.busy_cycles += taken;
    stats_.wait_cycles += now - entry.arrival;
  }
  stats_.occupancy_cycles += num_waiting_;
  return crossing;
}

std::vector<LineRequest> ResponseCrossbar::cross(Cycles now) {
  std::vector<LineRequest> leaving;
  for (auto entry = waiting_.begin(); entry != waiting_.end();) {
    if (!leaves(*entry, now)) {
      ++entry;
      continue;
    }
    leaving.push_back(entry->request);
    entry = waiting_.erase(entry);
  }
  return leaving;
}

bool ResponseCrossbar::leaves(const Entry& entry, Cycles now) {
  if (entry.request.write) return true;
  Cycles& free_at = banks_[entry.bank];
  if (free_at > now) return false;
  const Cycles taken = cycles_of(entry.request.bytes, spec_.response_width);
  free_at = now + taken;
  ++stats_.num_lines;
  stats_.busy_cycles += taken;
  stats_.wait_cycles += now - entry.ready;
  return true;
}

}  // namespace sheaf::clocked
