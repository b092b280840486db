// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/l2_cache.h"

#include <algorithm>

namespace sheaf::clocked {

L2Cache::L2Cache(const L2Spec& spec, const CrossbarSpec& crossbar, Dram& dram)
    : spec_(spec),
      crossbar_(crossbar),
      dram_(dram),
      answered_("answered", {.latency = spec.hit_latency, .interval = 0}) {
  for (std::uint32_t bank = 0; bank < spec.banks; ++bank) {
    ArrayShape shape = bank_shape(spec, spec.banks);
    shape.seed += bank;
    banks_.push_back({CacheArray(shape), {}, {}});
  }
  if (crossbar.request_width != 0) request_crossbar_.emplace(crossbar, banks_.size());
  if (crossbar.response_width != 0) response_crossbar_.emplace(crossbar, banks_.size());
}

void L2Cache::tick(Cycles now) {
  while (answered_.has_arrived(now)) respond(answered_.read(now), now);
  take_answers(now);
  if (response_crossbar_) {
    for (const LineRequest& request : response_crossbar_->cross(now)) send(request, now);
  }
  for (Bank& bank : banks_) {
    bank.ports_taken = 0;
    while (!bank.queue.empty() && can_take(bank) && serve(bank, bank.queue.front(), now)) {
      bank.queue.pop_front();
    }
  }
  take_requests(now);
  for (const Bank& bank : banks_) {
    stats_.queue_occupancy_cycles += bank.queue.size();
    stats_.mshr_occupancy_cycles += bank.mshrs.size();
  }
}

void L2Cache::take_requests(Cycles now) {
  for (Link<LineRequest>* requests : in_requests) {
    while (requests->has_arrived(now)) {
      const LineRequest request = requests->read(now);
      (request.write ? stats_.bytes_received : stats_.bytes_requested) += request.bytes;
      if (request_crossbar_) {
        request_crossbar_->push(request, bank_number(line_of(request.address)), now);
      } else {
        accept(request, now);
      }
    }
  }
  if (!request_crossbar_) return;
  const auto has_room = [this](std::size_t bank) {
    return crossbar_.depth == 0 || banks_[bank].queue.size() < crossbar_.depth;
  };
  for (const LineRequest& request : request_crossbar_->cross(has_room, now)) accept(request, now);
}

void L2Cache::respond(const LineRequest& request, Cycles now) {
  if (response_crossbar_) {
    response_crossbar_->push(request, bank_number(line_of(request.address)), now);
  } else {
    send(request, now);
  }
}

// The line that was asked for, or that a write was taken.
void L2Cache::send(const LineRequest& request, Cycles now) {
  const Address address = request.write ? LineResponse::kWriteTaken : request.address;
  out_responses[request.requester]->write({address}, now);
}

void L2Cache::take_answers(Cycles now) {
  while (dram_.has_answer(now)) {
    const Dram::Answer answer = dram_.take_answer();
    if (!answer.write) {
      fill(answer.address, now);
    } else if (spec_.write.buffer != 0) {
      --place_of(line_of(answer.address)).bank.writes_out;
    }
  }
}

void L2Cache::accept(const LineRequest& what, Cycles now) {
  Bank& bank = place_of(line_of(what.address)).bank;
  const Request request{what, now};
  if (bank.queue.empty() && can_take(bank) && serve(bank, request, now)) return;
  bank.queue.push_back(request);
}

bool L2Cache::can_take(const Bank& bank) const {
  const bool full = spec_.write.buffer != 0 && bank.writes_out >= spec_.write.buffer;
  return !bank.blocked && !full && bank.ports_taken < spec_.ports;
}

// False if the request has to wait for an MSHR.
bool L2Cache::serve(Bank& bank, const Request& request, Cycles now) {
  const bool done = request.what.write ? serve_write(bank, request.what, now)
                                       : serve_read(bank, request.what, now);
  if (!done) return false;
  ++stats_.num_accesses;
  ++kind_of(request.what).num_accesses;
  stats_.bank_wait_cycles += now - request.arrival;
  ++bank.ports_taken;
  return true;
}

bool L2Cache::serve_read(Bank& bank, const LineRequest& request, Cycles now) {
  const std::uint64_t line = line_of(request.address);
  if (spec_.mode == CacheMode::kPerfect || bank.array.touch(place_of(line).index)) {
    count_hit(request);
    answered_.write(request, now);
    return true;
  }
  if (Mshr* const mshr = find_mshr(bank, line)) {
    const bool full = spec_.mshr_targets != 0 && mshr->waiters.size() >= spec_.mshr_targets;
    if (full) return wait_for_room(bank, stats_.num_target_stalls);
    ++stats_.num_merges;
    mshr->waiters.push_back(request);
    return true;
  }
  if (bank.mshrs.size() == spec_.mshrs) return wait_for_room(bank, stats_.num_mshr_stalls);
  take_mshr(bank, request, now).waiters.push_back(request);
  return true;
}

bool L2Cache::serve_write(Bank& bank, const LineRequest& request, Cycles now) {
  const std::uint64_t index = place_of(line_of(request.address)).index;
  const bool through = spec_.write.policy == WritePolicy::kThrough;
  if (spec_.mode == CacheMode::kPerfect) {
    count_hit(request);
  } else if (bank.array.touch(index)) {
    count_hit(request);
    through ? pass_on(request, now) : bank.array.mark_dirty(index);
  } else if (spec_.mode == CacheMode::kNormal && spec_.write.allocate) {
    if (!write_missing(bank, request, now)) return false;
    if (through) pass_on(request, now);
  } else {
    ++stats_.num_misses;
    pass_on(request, now);
  }
  if (request.acknowledged) answered_.write(request, now);
  return true;
}

// Gives a place to a line that is written: at once if all of it is, or when it has been fetched.
bool L2Cache::write_missing(Bank& bank, const LineRequest& request, Cycles now) {
  const std::uint64_t line = line_of(request.address);
  const bool dirty = spec_.write.policy == WritePolicy::kBack;
  if (Mshr* const mshr = find_mshr(bank, line)) {
    ++stats_.num_merges;
    mshr->dirty |= dirty;
  } else if (request.bytes == line_size()) {
    ++stats_.num_misses;
    put(line, dirty, now);
  } else {
    if (bank.mshrs.size() == spec_.mshrs) return wait_for_room(bank, stats_.num_mshr_stalls);
    take_mshr(bank, request, now).dirty = dirty;
  }
  return true;
}

L2Cache::Mshr* L2Cache::find_mshr(Bank& bank, std::uint64_t line) {
  const auto found = std::find_if(bank.mshrs.begin(), bank.mshrs.end(),
                                  [&](const Mshr& mshr) { return mshr.line == line; });
  return found == bank.mshrs.end() ? nullptr : &*found;
}

// For a line that is asked of DRAM; there must be one free.
L2Cache::Mshr& L2Cache::take_mshr(Bank& bank, const LineRequest& request, Cycles now) {
  const std::uint64_t line = line_of(request.address);
  ++stats_.num_misses;
  kind_of(request).bytes_read += line_size();
  send_to_dram(line * line_size(), line_size(), false, now);
  bank.mshrs.push_back({line, now, false, {}});
  return bank.mshrs.back();
}

bool L2Cache::wait_for_room(Bank& bank, std::uint64_t& counter) {
  ++counter;
  bank.blocked = true;
  return false;
}

void L2Cache::count_hit(const LineRequest& request) {
  ++stats_.num_hits;
  ++kind_of(request).num_hits;
}

void L2Cache::fill(Address address, Cycles now) {
  const std::uint64_t line = line_of(address);
  Bank& bank = place_of(line).bank;
  const Mshr mshr = *find_mshr(bank, line);
  std::erase_if(bank.mshrs, [&](const Mshr& m) { return m.line == line; });
  stats_.sum_miss_latency += now - mshr.since;
  for (const LineRequest& waiter : mshr.waiters) respond(waiter, now);
  bank.blocked = false;
  put(line, mshr.dirty, now);
}

// Puts a line in; what of another one is dirty leaves for DRAM.
void L2Cache::put(std::uint64_t line, bool dirty, Cycles now) {
  const Place place = place_of(line);
  const CacheArray::Victim victim = place.bank.array.fill(place.index, dirty);
  const std::uint64_t tag = victim.line / spec_.sectors * spec_.banks + bank_number(line);
  for (std::uint32_t sector = 0; sector < spec_.sectors; ++sector) {
    if ((victim.dirty >> sector & 1U) == 0) continue;
    ++stats_.num_writebacks;
    send_to_dram((tag * spec_.sectors + sector) * line_size(), line_size(), true, now);
  }
}

// Written data that leave for DRAM without a line.
void L2Cache::pass_on(const LineRequest& request, Cycles now) {
  kind_of(request).bytes_written += request.bytes;
  send_to_dram(request.address, request.bytes, true, now);
}

void L2Cache::send_to_dram(Address address, Bytes bytes, bool write, Cycles now) {
  (write ? stats_.bytes_written : stats_.bytes_read) += bytes;
  if (write && spec_.write.buffer != 0) ++place_of(line_of(address)).bank.writes_out;
  dram_.requests.write({address, bytes, write}, now);
}

L2Cache::Place L2Cache::place_of(std::uint64_t line) {
  const std::uint64_t tag = line / spec_.sectors;
  return {banks_[bank_number(line)], tag / spec_.banks * spec_.sectors + line % spec_.sectors};
}

bool L2Cache::is_idle() const {
  const bool idle = std::all_of(banks_.begin(), banks_.end(), [](const Bank& bank) {
    return bank.queue.empty() && bank.mshrs.empty() && bank.writes_out == 0;
  });
  const bool nothing_crosses = (!request_crossbar_ || request_crossbar_->is_empty()) &&
                               (!response_crossbar_ || response_crossbar_->is_empty());
  return idle && nothing_crosses && answered_.size() == 0 &&
         std::all_of(in_requests.begin(), in_requests.end(),
                     [](const Link<LineRequest>* requests) { return requests->size() == 0; });
}

// A bank whose first request waits while nothing is under way waits for ever, and so does what
// stands in the crossbar for it.
bool L2Cache::is_moving() const {
  const auto awaits = [](const Bank& bank) { return !bank.mshrs.empty() || bank.writes_out != 0; };
  const bool stuck =
      std::ranges::any_of(banks_, [&](const Bank& bank) { return bank.blocked && !awaits(bank); });
  const bool crosses = (request_crossbar_ && !request_crossbar_->is_empty() && !stuck) ||
                       (response_crossbar_ && !response_crossbar_->is_empty());
  return crosses || answered_.size() != 0 || std::ranges::any_of(banks_, [&](const Bank& bank) {
           return awaits(bank) || (!bank.queue.empty() && !bank.blocked);
         });
}

}  // namespace sheaf::clocked
