// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/l2_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace sheaf {
namespace {

std::uint32_t sets_per_bank(const L2Spec& spec) {
  if (spec.mode != CacheMode::kNormal) return 0;
  return static_cast<std::uint32_t>(spec.capacity / (spec.line * spec.ways * spec.banks));
}

// A write-back carries at most one line of a private cache, which is no longer than the L2's.
constexpr std::size_t kMaxLine = 4096;

}  // namespace

L2Cache::L2Cache(const sc_core::sc_module_name& name, const L2Spec& spec, ClockDomain& domain)
    : sc_module(name),
      in_requests("in_requests"),
      out_responses("out_responses"),
      to_dram("to_dram"),
      spec_(spec),
      domain_(domain),
      agent_(domain.add(*this)),
      lag_(spec.hit_latency - 1),
      line_shift_(static_cast<unsigned>(std::countr_zero(spec.line))),
      bank_shift_(static_cast<unsigned>(std::countr_zero(spec.banks))),
      payloads_(kMaxLine) {
  inbox_.bind(domain, agent_, lag_);
  for (std::uint32_t bank = 0; bank < spec.banks; ++bank) {
    banks_.push_back({CacheArray(sets_per_bank(spec), spec.ways), {}, {}, 0, 0, false});
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
  while (!fills_.empty() && fills_.top().at <= now) {
    const Address address = fills_.top().address;
    fills_.pop();
    fill(address, now);
  }
  // Requests that have waited come before those that arrive now.
  if (num_queued_ != 0) serve_queues(now);
  while (*next_request_ <= now) accept(in_requests->read(now), now);
}

void L2Cache::serve_queues(Cycles now) {
  for (Bank& bank : banks_) {
    if (bank.queue.empty() || bank.blocked || bank.free_at > now) continue;
    if (serve(bank, bank.queue.front(), now)) {
      bank.queue.pop_front();
      --num_queued_;
    }
  }
}

// With requests put off by `lag`.
Cycles L2Cache::next_event(Cycles lag) const {
  Cycles next = *next_request_;
  if (num_queued_ != 0) {
    for (const Bank& bank : banks_) {
      if (!bank.queue.empty() && !bank.blocked) next = std::min(next, bank.free_at);
    }
  }
  if (next != kNever) next += lag;
  return fills_.empty() ? next : std::min(next, fills_.top().at);
}

void L2Cache::accept(const LineRequest& what, Cycles now) {
  (what.write ? stats_.bytes_received : stats_.bytes_requested) += what.bytes;
  Bank& bank = bank_of(line_of(what.address));
  const Request request{what, now};
  if (bank.queue.empty() && bank.free_at <= now && serve(bank, request, now)) return;
  bank.queue.push_back(request);
  ++num_queued_;
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
  if (spec_.mode == CacheMode::kPerfect || bank.array.touch(index_in_bank(line))) {
    ++stats_.num_hits;
    ++kind_of(request).num_hits;
    responses_[request.requester]->write_ahead({request.address}, now + spec_.hit_latency);
    return true;
  }
  for (std::size_t i = 0; i < bank.num_mshrs; ++i) {
    if (bank.mshrs[i].line != line) continue;
    ++stats_.num_merges;
    bank.mshrs[i].waiters.push_back(request);
    return true;
  }
  if (bank.num_mshrs == spec_.mshrs) return false;
  ++stats_.num_misses;
  kind_of(request).bytes_read += spec_.line;
  if (bank.num_mshrs == bank.mshrs.size()) bank.mshrs.emplace_back();
  Mshr& mshr = bank.mshrs[bank.num_mshrs++];
  mshr.line = line;
  mshr.waiters.assign(1, request);
  send_to_dram(line << line_shift_, spec_.line, false, now + spec_.hit_latency);
  return true;
}

void L2Cache::serve_write(Bank& bank, const LineRequest& request, Cycles now) {
  const std::uint64_t index = index_in_bank(line_of(request.address));
  if (spec_.mode == CacheMode::kPerfect || bank.array.touch(index)) {
    ++stats_.num_hits;
    ++kind_of(request).num_hits;
    if (spec_.mode == CacheMode::kNormal) bank.array.mark_dirty(index);
    return;
  }
  ++stats_.num_misses;
  kind_of(request).bytes_written += request.bytes;
  send_to_dram(request.address, request.bytes, true, now + spec_.hit_latency);
}

void L2Cache::fill(Address address, Cycles now) {
  const std::uint64_t line = line_of(address);
  Bank& bank = bank_of(line);
  std::size_t i = 0;
  while (bank.mshrs[i].line != line) ++i;
  for (const LineRequest& waiter : bank.mshrs[i].waiters) {
    responses_[waiter.requester]->write_ahead({waiter.address}, now);
  }
  std::swap(bank.mshrs[i], bank.mshrs[--bank.num_mshrs]);
  if (bank.blocked) {
    bank.blocked = false;
    bank.free_at = std::max(bank.free_at, now);
  }
  const CacheArray::Victim victim = bank.array.fill(index_in_bank(line), false);
  if (!victim.valid || !victim.dirty) return;
  ++stats_.num_writebacks;
  const std::uint64_t bank_number = line & (banks_.size() - 1);
  send_to_dram(((victim.line << bank_shift_) | bank_number) << line_shift_, spec_.line, true,
               now + spec_.hit_latency);
}

void L2Cache::send_to_dram(Address address, Bytes bytes, bool write, Cycles at) {
  (write ? stats_.bytes_written : stats_.bytes_read) += bytes;
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
  if (payload.is_write()) return;
  fills_.push({at, payload.get_address()});
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

bool L2Cache::is_idle() const {
  const bool banks_idle = std::all_of(banks_.begin(), banks_.end(), [](const Bank& bank) {
    return bank.queue.empty() && bank.num_mshrs == 0;
  });
  return banks_idle && fills_.empty() && *next_request_ == kNever;
}

std::string L2Cache::stuck_reason() const {
  std::size_t queued = 0;
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
