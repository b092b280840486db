// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/l2_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace sheaf {
namespace {

// A write-back carries at most one line of a private cache, which is no longer than the L2's.
constexpr std::size_t kMaxLine = 4096;

}  // namespace

L2Cache::L2Cache(const sc_core::sc_module_name& name, const L2Spec& spec,
                 const CrossbarSpec& crossbar, ClockDomain& domain)
    : sc_module(name),
      in_requests("in_requests"),
      out_responses("out_responses"),
      to_dram("to_dram"),
      spec_(spec),
      crossbar_(crossbar),
      domain_(domain),
      agent_(domain.add(*this)),
      lag_(spec.hit_latency - 1),
      line_shift_(static_cast<unsigned>(std::countr_zero(spec.line / spec.sectors))),
      bank_shift_(static_cast<unsigned>(std::countr_zero(spec.banks))),
      sector_shift_(static_cast<unsigned>(std::countr_zero(spec.sectors))),
      payloads_(kMaxLine) {
  inbox_.bind(domain, agent_, lag_);
  for (std::uint32_t bank = 0; bank < spec.banks; ++bank) {
    ArrayShape shape = bank_shape(spec, spec.banks);
    shape.seed += bank;
    banks_.push_back({.array = CacheArray(shape)});
  }
  to_dram.register_nb_transport_bw(this, &L2Cache::nb_transport_bw);
}

void L2Cache::end_of_elaboration() {
  in_requests->set_consumer(inbox_);
  next_request_ = &in_requests->next_arrival();
  for (int i = 0; i < out_responses.size(); ++i) {
    out_responses[i]->add_producer(inbox_);
    responses_.push_back(out_responses[i]);
  }
  if (crossbar_.request_width != 0) {
    request_crossbar_.emplace(crossbar_, responses_.size(), banks_.size());
  }
  if (crossbar_.response_width != 0) response_crossbar_.emplace(crossbar_, banks_.size());
}

void L2Cache::expect_answers_from(std::size_t memory) {
  memories_.push_back(memory);
  domain_.declare_link(memory, agent_, 1);
  domain_.declare_link(agent_, memory, 1);
}

void L2Cache::start_of_simulation() {
  std::vector<std::size_t> sources = in_requests->producers();
  sources.insert(sources.end(), memories_.begin(), memories_.end());
  requests_ahead_.bind(domain_, sources, agent_);
}

Cycles L2Cache::wake(Cycles now) {
  // A response may bring the next request nearer.
  for (Cycles next = next_event(); is_safe(next, now); next = next_event()) act(next);
  return next_event(lag_);
}

// Whether nothing that may still come can arrive before the event or with it.
bool L2Cache::is_safe(Cycles event, Cycles now) const {
  if (event <= now) return true;
  if (domain_.in_step() || event >= domain_.limit() || event >= domain_.end()) return false;
  return requests_ahead_.is_beyond(event);
}

// With a quantum an event may lie behind others that have been dealt with.
void L2Cache::act(Cycles event) {
  const Cycles now = own_time_ = std::max(own_time_, event);
  domain_.happened(now);
  if (!answers_.empty() && answers_.top().at <= now) take_answers(now);
  if (response_crossbar_) {
    response_crossbar_->cross(
        now, [this](const LineRequest& request, Cycles start) { send(request, start); });
  }
  // Requests that have waited come before those that arrive now.
  if (num_queued_ != 0) serve_queues(now);
  while (*next_request_ <= now) arrive(in_requests->read(now), now);
  if (request_crossbar_) cross(now);
}

void L2Cache::cross(Cycles now) {
  request_crossbar_->cross(
      now, [this](std::size_t bank) { return has_room(bank); },
      [&](std::size_t /*bank*/, const LineRequest& request) { accept(request, now); });
}

void L2Cache::take_answers(Cycles now) {
  while (!answers_.empty() && answers_.top().at <= now) {
    const Answer answer = answers_.top();
    answers_.pop();
    if (!answer.write) {
      fill(answer.address, now);
      continue;
    }
    Bank& bank = bank_of(line_of(answer.address));
    --bank.num_writes_out;
    bank.free_at = std::max(bank.free_at, now);
  }
}

void L2Cache::serve_queues(Cycles now) {
  for (Bank& bank : banks_) {
    while (!bank.queue.empty() && bank.free_at <= now && can_take(bank)) {
      if (!serve(bank, bank.queue.front(), now)) break;
      bank.queue.pop_front();
      count_queued(-1, now);
    }
  }
}

Cycles L2Cache::next_queued() const {
  Cycles next = kNever;
  for (const Bank& bank : banks_) {
    if (!bank.queue.empty() && can_take(bank)) next = std::min(next, bank.free_at);
  }
  return next;
}

Cycles L2Cache::next_crossing() const {
  return request_crossbar_->next_event([this](std::size_t bank) { return has_room(bank); });
}

void L2Cache::arrive(const LineRequest& request, Cycles now) {
  (request.write ? stats_.bytes_received : stats_.bytes_requested) += request.bytes;
  if (request_crossbar_) {
    request_crossbar_->push(request, place_of(line_of(request.address)).bank, now);
  } else {
    accept(request, now);
  }
}

void L2Cache::accept(const LineRequest& what, Cycles now) {
  Bank& bank = bank_of(line_of(what.address));
  const Request request{what, now};
  const bool at_once = bank.queue.empty() && bank.free_at <= now && can_take(bank);
  if (at_once && serve(bank, request, now)) return;
  bank.queue.push_back(request);
  count_queued(1, now);
}

void L2Cache::count_queued(std::ptrdiff_t change, Cycles now) {
  stats_.queue_occupancy_cycles += num_queued_ * (now - queues_counted_until_);
  queues_counted_until_ = now;
  num_queued_ += static_cast<std::size_t>(change);
}

void L2Cache::count_mshrs(std::ptrdiff_t change, Cycles now) {
  stats_.mshr_occupancy_cycles += num_outstanding_ * (now - mshrs_counted_until_);
  mshrs_counted_until_ = now;
  num_outstanding_ += static_cast<std::size_t>(change);
}

// False if the request has to wait for an MSHR.
bool L2Cache::serve(Bank& bank, const Request& request, Cycles now) {
  const bool done = request.what.write ? serve_write(bank, request.what, now)
                                       : serve_read(bank, request.what, now);
  if (!done) return false;
  ++stats_.num_accesses;
  ++kind_of(request.what).num_accesses;
  stats_.bank_wait_cycles += now - request.arrival;
  if (bank.taken_at != now) bank.num_taken = 0;
  bank.taken_at = now;
  bank.free_at = ++bank.num_taken == spec_.ports ? now + 1 : now;
  return true;
}

bool L2Cache::wait_for(Bank& bank, std::uint64_t& counter) {
  ++counter;
  bank.blocked = true;
  return false;
}

L2Cache::Mshr* L2Cache::find_mshr(Bank& bank, std::uint64_t line) {
  for (std::size_t i = 0; i < bank.num_mshrs; ++i) {
    if (bank.mshrs[i].line == line) return &bank.mshrs[i];
  }
  return nullptr;
}

// For a line that is then asked of DRAM; there must be one free.
L2Cache::Mshr& L2Cache::take_mshr(Bank& bank, const LineRequest& request, Cycles now) {
  count_mshrs(1, now);
  ++stats_.num_misses;
  kind_of(request).bytes_read += line_size();
  if (bank.num_mshrs == bank.mshrs.size()) bank.mshrs.emplace_back();
  Mshr& mshr = bank.mshrs[bank.num_mshrs++];
  mshr.line = line_of(request.address);
  mshr.since = now;
  mshr.dirty = false;
  mshr.waiters.clear();
  send_to_dram(mshr.line << line_shift_, line_size(), false, now + spec_.hit_latency);
  return mshr;
}

bool L2Cache::serve_read(Bank& bank, const LineRequest& request, Cycles now) {
  const std::uint64_t line = line_of(request.address);
  if (spec_.mode == CacheMode::kPerfect || bank.array.touch(place_of(line).index)) {
    ++stats_.num_hits;
    ++kind_of(request).num_hits;
    respond(request, now + spec_.hit_latency);
    return true;
  }
  if (Mshr* const mshr = find_mshr(bank, line)) {
    if (spec_.mshr_targets != 0 && mshr->waiters.size() >= spec_.mshr_targets) {
      return wait_for(bank, stats_.num_target_stalls);
    }
    ++stats_.num_merges;
    mshr->waiters.push_back(request);
    return true;
  }
  if (bank.num_mshrs == spec_.mshrs) return wait_for(bank, stats_.num_mshr_stalls);
  take_mshr(bank, request, now).waiters.push_back(request);
  return true;
}

bool L2Cache::serve_write(Bank& bank, const LineRequest& request, Cycles now) {
  const std::uint64_t index = place_of(line_of(request.address)).index;
  const bool through = spec_.write.policy == WritePolicy::kThrough;
  if (spec_.mode == CacheMode::kPerfect || bank.array.touch(index)) {
    ++stats_.num_hits;
    ++kind_of(request).num_hits;
    if (spec_.mode == CacheMode::kNormal && !through) bank.array.mark_dirty(index);
    if (spec_.mode == CacheMode::kNormal && through) pass_on(request, now);
  } else if (spec_.mode == CacheMode::kNormal && spec_.write.allocate) {
    if (!write_missing(bank, request, now)) return false;
    if (through) pass_on(request, now);
  } else {
    ++stats_.num_misses;
    pass_on(request, now);
  }
  if (request.acknowledged) respond(request, now + spec_.hit_latency);
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
    put(place_of(line), dirty, now);
  } else {
    if (bank.num_mshrs == spec_.mshrs) return wait_for(bank, stats_.num_mshr_stalls);
    take_mshr(bank, request, now).dirty = dirty;
  }
  return true;
}

// Written data that leave for DRAM without a line.
void L2Cache::pass_on(const LineRequest& request, Cycles now) {
  kind_of(request).bytes_written += request.bytes;
  send_to_dram(request.address, request.bytes, true, now + spec_.hit_latency);
}

void L2Cache::respond(const LineRequest& request, Cycles ready) {
  if (response_crossbar_) {
    response_crossbar_->push(place_of(line_of(request.address)).bank, request, ready);
  } else {
    send(request, ready);
  }
}

// The line that was asked for, or that a write was taken.
void L2Cache::send(const LineRequest& request, Cycles at) {
  const Address address = request.write ? LineResponse::kWriteTaken : request.address;
  responses_[request.requester]->write_ahead({address}, at);
}

void L2Cache::fill(Address address, Cycles now) {
  const std::uint64_t line = line_of(address);
  const Place where = place_of(line);
  Bank& bank = banks_[where.bank];
  Mshr& mshr = *find_mshr(bank, line);
  count_mshrs(-1, now);
  stats_.sum_miss_latency += now - mshr.since;
  for (const LineRequest& waiter : mshr.waiters) respond(waiter, now);
  const bool dirty = mshr.dirty;
  std::swap(mshr, bank.mshrs[--bank.num_mshrs]);
  if (bank.blocked) {
    bank.blocked = false;
    bank.free_at = std::max(bank.free_at, now);
  }
  put(where, dirty, now);
}

// Puts a line in; what of another one is dirty leaves for DRAM.
void L2Cache::put(const Place& where, bool dirty, Cycles now) {
  CacheArray& array = banks_[where.bank].array;
  if (was_loaded_ && array.touch(where.index)) {
    if (dirty) array.mark_dirty(where.index);
    return;
  }
  const CacheArray::Victim victim = array.fill(where.index, dirty);
  if (victim.dirty == 0) return;
  const std::uint64_t first = line_at({where.bank, victim.line});
  for (std::uint32_t left = victim.dirty; left != 0; left &= left - 1) {
    ++stats_.num_writebacks;
    const std::uint64_t leaving = first + static_cast<std::uint32_t>(std::countr_zero(left));
    send_to_dram(leaving << line_shift_, line_size(), true, now + spec_.hit_latency);
  }
}

void L2Cache::send_to_dram(Address address, Bytes bytes, bool write, Cycles at) {
  (write ? stats_.bytes_written : stats_.bytes_read) += bytes;
  if (write && spec_.write.buffer != 0) ++bank_of(line_of(address)).num_writes_out;
  tlm::tlm_generic_payload* payload =
      payloads_.acquire(address, static_cast<std::uint32_t>(bytes), write);
  tlm::tlm_phase phase = tlm::BEGIN_REQ;
  sc_core::sc_time delay = domain_.offset(at);
  const tlm::tlm_sync_enum status = to_dram->nb_transport_fw(*payload, phase, delay);
  const bool answered =
      status == tlm::TLM_COMPLETED || (status == tlm::TLM_UPDATED && phase == tlm::BEGIN_RESP);
  if (answered) {
    dram_done(*payload, domain_.cycle_at(delay));
    payload->release();
  } else {
    domain_.kernel_touched();
  }
}

void L2Cache::dram_done(const tlm::tlm_generic_payload& payload, Cycles at) {
  // Of writes only those are of interest that something waits for.
  if (payload.is_write() && spec_.write.buffer == 0) return;
  answers_.push({at, payload.get_address(), payload.is_write()});
  inbox_.nudge(at);
}

tlm::tlm_sync_enum L2Cache::nb_transport_bw(tlm::tlm_generic_payload& payload,
                                            tlm::tlm_phase& phase, sc_core::sc_time& delay) {
  if (phase != tlm::BEGIN_RESP) return tlm::TLM_ACCEPTED;
  // Called by a DRAM model that answers in its own time, from a process of its own.
  dram_done(payload, domain_.cycle_at_kernel_offset(delay));
  payload.release();
  return tlm::TLM_COMPLETED;
}

void L2Cache::load(const std::vector<CacheArray>& banks) {
  for (std::size_t i = 0; i < banks_.size(); ++i) banks_[i].array = banks[i];
  was_loaded_ = true;
}

bool L2Cache::is_idle() const {
  const bool banks_idle = std::all_of(banks_.begin(), banks_.end(), [](const Bank& bank) {
    return bank.queue.empty() && bank.num_mshrs == 0;
  });
  const bool nothing_crosses = (!request_crossbar_ || request_crossbar_->num_waiting() == 0) &&
                               (!response_crossbar_ || response_crossbar_->is_empty());
  return banks_idle && nothing_crosses && answers_.empty() && *next_request_ == kNever;
}

std::string L2Cache::stuck_reason() const {
  std::size_t queued = request_crossbar_ ? request_crossbar_->num_waiting() : 0;
  std::size_t outstanding = 0;
  for (const Bank& bank : banks_) {
    queued += bank.queue.size();
    outstanding += bank.num_mshrs;
  }
  if (queued + outstanding == 0) return {};
  return fmt::format("{}: {} requests queued, {} lines awaited from DRAM", name(), queued,
                     outstanding);
}

}  // namespace sheaf
