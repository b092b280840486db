// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/l2_cache.h"

#include <algorithm>

namespace sheaf::clocked {
L2Cache::L2Cache(const L2Spec& spec, Dram& dram)
    : spec_(spec), dram_(dram), hits_("hits", {.latency = spec.hit_latency, .interval = 0}) {
  for (std::uint32_t bank = 0; bank < spec.banks; ++bank) {
    ArrayShape shape = bank_shape(spec, spec.banks);
    shape.seed += bank;
    banks_.push_back({CacheArray(shape), {}, {}, 0, false});
  }
}

void L2Cache::tick(Cycles now) {
  while (hits_.has_arrived(now)) {
    const LineRequest hit = hits_.read(now);
    out_responses[hit.requester]->write({hit.address}, now);
  }
  while (dram_.line_has_arrived(now)) fill(dram_.take_line(), now);
  for (Bank& bank : banks_) {
    if (bank.queue.empty() || bank.blocked || bank.free_at > now) continue;
    if (serve(bank, bank.queue.front(), now)) bank.queue.pop_front();
  }
  for (Link<LineRequest>* requests : in_requests) {
    while (requests->has_arrived(now)) accept(requests->read(now), now);
  }
  for (const Bank& bank : banks_) {
    stats_.queue_occupancy_cycles += bank.queue.size();
    stats_.mshr_occupancy_cycles += bank.mshrs.size();
  }
}

void L2Cache::accept(const LineRequest& what, Cycles now) {
  (what.write ? stats_.bytes_received : stats_.bytes_requested) += what.bytes;
  Bank& bank = bank_of(line_of(what.address));
  const Request request{what, now};
  if (bank.queue.empty() && bank.free_at <= now && serve(bank, request, now)) return;
  bank.queue.push_back(request);
}

// False if the request has to wait for an MSHR.
bool L2Cache::serve(Bank& bank, const Request& request, Cycles now) {
  if (request.what.write) {
    serve_write(bank, request.what, now);
  } else if (!serve_read(bank, request.what, now)) {
    ++stats_.num_mshr_stalls;
    bank.blocked = true;
    return false;
  }
  ++stats_.num_accesses;
  ++kind_of(request.what).num_accesses;
  stats_.bank_wait_cycles += now - request.arrival;
  bank.free_at = now + 1;
  return true;
}

bool L2Cache::serve_read(Bank& bank, const LineRequest& request, Cycles now) {
  const std::uint64_t line = line_of(request.address);
  if (spec_.mode == CacheMode::kPerfect || bank.array.touch(line / spec_.banks)) {
    ++stats_.num_hits;
    ++kind_of(request).num_hits;
    hits_.write(request, now);
    return true;
  }
  const auto mshr = std::find_if(bank.mshrs.begin(), bank.mshrs.end(),
                                 [&](const Mshr& m) { return m.line == line; });
  if (mshr != bank.mshrs.end()) {
    ++stats_.num_merges;
    mshr->waiters.push_back(request);
    return true;
  }
  if (bank.mshrs.size() == spec_.mshrs) return false;
  ++stats_.num_misses;
  kind_of(request).bytes_read += spec_.line;
  bank.mshrs.push_back({line, now, {request}});
  send_to_dram(line * spec_.line, spec_.line, false, now);
  return true;
}

// A line that is not there goes on to DRAM and takes no place.
void L2Cache::serve_write(Bank& bank, const LineRequest& request, Cycles now) {
  const std::uint64_t index = line_of(request.address) / spec_.banks;
  if (spec_.mode == CacheMode::kPerfect || bank.array.touch(index)) {
    ++stats_.num_hits;
    ++kind_of(request).num_hits;
    if (spec_.mode == CacheMode::kNormal) bank.array.mark_dirty(index);
    return;
  }
  ++stats_.num_misses;
  kind_of(request).bytes_written += request.bytes;
  send_to_dram(request.address, request.bytes, true, now);
}

void L2Cache::fill(Address address, Cycles now) {
  const std::uint64_t line = line_of(address);
  Bank& bank = bank_of(line);
  const auto mshr = std::find_if(bank.mshrs.begin(), bank.mshrs.end(),
                                 [&](const Mshr& m) { return m.line == line; });
  for (const LineRequest& waiter : mshr->waiters) {
    out_responses[waiter.requester]->write({waiter.address}, now);
  }
  stats_.sum_miss_latency += now - mshr->since;
  bank.mshrs.erase(mshr);
  bank.blocked = false;
  const CacheArray::Victim victim = bank.array.fill(line / spec_.banks, false);
  if (!victim.valid || !victim.dirty) return;
  ++stats_.num_writebacks;
  const std::uint64_t victim_line = victim.line * spec_.banks + line % spec_.banks;
  send_to_dram(victim_line * spec_.line, spec_.line, true, now);
}

void L2Cache::send_to_dram(Address address, Bytes bytes, bool write, Cycles now) {
  (write ? stats_.bytes_written : stats_.bytes_read) += bytes;
  dram_.requests.write({address, bytes, write}, now);
}

bool L2Cache::is_idle() const {
  const bool idle = std::all_of(banks_.begin(), banks_.end(), [](const Bank& bank) {
    return bank.queue.empty() && bank.mshrs.empty();
  });
  return idle && hits_.size() == 0 &&
         std::all_of(in_requests.begin(), in_requests.end(),
                     [](const Link<LineRequest>* requests) { return requests->size() == 0; });
}

bool L2Cache::is_moving() const {
  return hits_.size() != 0 || std::any_of(banks_.begin(), banks_.end(), [](const Bank& bank) {
           return !bank.mshrs.empty() || (!bank.queue.empty() && !bank.blocked);
         });
}

}  // namespace sheaf::clocked
