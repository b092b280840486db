// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/crossbar.h"

namespace sheaf {
namespace {

Cycles cycles_of(Bytes bytes, Bytes width) {
  return (bytes + width - 1) / width;
}

}  // namespace

void RequestCrossbar::count_occupancy(Cycles now) {
  stats_.occupancy_cycles += num_waiting_ * (now - counted_until_);
  counted_until_ = now;
}

void RequestCrossbar::push(const LineRequest& request, std::size_t bank, Cycles now) {
  count_occupancy(now);
  caches_[request.requester].queue.push_back({request, bank, now});
  stats_.max_waiting = std::max<std::uint64_t>(stats_.max_waiting, ++num_waiting_);
}

LineRequest RequestCrossbar::take(Cache& cache, Cycles now) {
  count_occupancy(now);
  const Entry entry = cache.queue.front();
  cache.queue.pop_front();
  --num_waiting_;
  const Cycles taken =
      entry.request.write ? cycles_of(entry.request.bytes, spec_.request_width) : 1;
  cache.free_at = now + taken;
  bank_free_[entry.bank] = now + taken;
  ++stats_.num_requests;
  stats_.busy_cycles += taken;
  stats_.wait_cycles += now - entry.arrival;
  return entry.request;
}

Cycles ResponseCrossbar::leave(const Entry& entry) {
  if (entry.request.write) return entry.ready;
  Cycles& free = banks_[entry.bank];
  const Cycles start = std::max(entry.ready, free);
  const Cycles taken = cycles_of(entry.request.bytes, spec_.response_width);
  free = start + taken;
  ++stats_.num_lines;
  stats_.busy_cycles += taken;
  stats_.wait_cycles += start - entry.ready;
  return start;
}

}  // namespace sheaf
