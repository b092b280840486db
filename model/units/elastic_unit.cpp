// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/elastic_unit.h"

#include <algorithm>

#include "units/replayed_lines.h"

namespace sheaf {
namespace {

// Its steps bring their own port cycles and latencies.
UnitSpec spec_of(const MemoryTraceStream& stream) {
  return {.count = 1,
          .contexts = stream.contexts,
          .lanes = 1,
          .initiation_interval = stream.retry_interval,
          .latency = 0};
}

}  // namespace

ElasticUnit::ElasticUnit(const sc_core::sc_module_name& name, const MemoryLayout& layout,
                         std::size_t stream, ReplaySchedule& schedule, ClockDomain& domain)
    : MultiContextUnit(name, spec_of(layout.streams[stream]), 1, domain),
      layout_(layout),
      stream_(stream),
      schedule_(schedule),
      contexts_(layout.streams[stream].contexts),
      num_free_(contexts_.size()) {}

void ElasticUnit::add_cache(const CacheSpec& spec, TimedOut<LineRequest>& requests,
                            std::uint16_t requester, TimedIn<LineResponse>& lines) {
  caches_.push_back(std::make_unique<Cache>(spec, requests, requester, lines));
  caches_.back()->cache.bind(inbox_);
  lines.set_consumer(inbox_);
}

// The context that is free first, of these the lowest.
void ElasticUnit::assign(ReplayChain& chain, Cycles at) {
  int first = -1;
  for (std::size_t i = 0; i < contexts_.size(); ++i) {
    if (contexts_[i].phase != Phase::kIdle) continue;
    const bool earlier =
        first < 0 || std::max(at, contexts_[i].free_at) <
                         std::max(at, contexts_[static_cast<std::size_t>(first)].free_at);
    if (earlier) first = static_cast<int>(i);
  }
  begin(first, chain, at);
}

void ElasticUnit::begin(int number, ReplayChain& chain, Cycles at) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  context.chain = &chain;
  context.phase = Phase::kBegin;
  --num_free_;
  const Cycles begin = std::max(at, context.free_at);
  schedule(number, begin);
  inbox_.nudge(begin);
}

void ElasticUnit::answered(int number, std::uint64_t record, Cycles at) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  if (context.phase != Phase::kCalled) return;
  if (context.chain->steps[context.chain->next].number != record) return;
  context.phase = Phase::kAnswered;
  schedule(number, at);
  inbox_.nudge(at);
}

void ElasticUnit::all_done(Cycles now) {
  if (!layout_.streams[stream_].awaited) inbox_.expect(now + 1);
}

bool ElasticUnit::is_quiet() const {
  return std::ranges::none_of(caches_, [](const auto& own) { return own->cache.has_pending(); });
}

Cycles ElasticUnit::accept_inputs(Cycles now) {
  const bool awaited = layout_.streams[stream_].awaited;
  Cycles next = kNever;
  for (auto& own : caches_) {
    while (own->lines.has_arrived(now)) {
      const LineResponse line = own->lines.read(now);
      if (awaited) {
        own->fetcher.fill(line, now, [&](int context) { unpark(context, now); });
      } else {
        std::uint64_t retry = 0;
        own->cache.fill(line, now, retry);
        for (; retry != 0; retry &= retry - 1) unpark(std::countr_zero(retry), now);
      }
    }
    next = std::min(next, own->lines.next_arrival());
  }
  return std::min(next, flush_if_due(now));
}

// What it does may let other units act earlier than was known.
bool ElasticUnit::ready(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  look_again();
  switch (context.phase) {
    case Phase::kIdle:
    case Phase::kCalled:
      return false;
    case Phase::kBegin:
      return begin_step(number, now);
    case Phase::kStep:
      return true;
    case Phase::kIssued:
      return finish_step(number, now);
    case Phase::kAnswered:
      return leave_step(number, now);
  }
  return false;
}

bool ElasticUnit::begin_step(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  // A chain without end: the replay will not come to its own.
  const bool has_step = schedule_.has_step(*context.chain, now);
  context.phase = has_step ? Phase::kStep : Phase::kCalled;
  return has_step;
}

bool ElasticUnit::leave_step(int number, Cycles now) {
  ReplayChain& chain = *contexts_[static_cast<std::size_t>(number)].chain;
  const ReplayStep step = chain.steps[chain.next];
  schedule_.leave_step(chain, now);
  if (!step.record.ends) return begin_step(number, now);
  end_chain(number, step.number, now);
  return false;
}

void ElasticUnit::issue(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  const MemoryOperation& operation = operation_of(context);
  if (operation.bytes == 0) {
    context.num_accesses = 1;
    context.phase = Phase::kIssued;
    occupy(number, 0, operation.latency, operation.port_cycles, now);
    return;
  }
  Cache& own = *caches_[operation.cache];
  if (operation.write) {
    issue_write(number, now);
    return;
  }
  if (context.lines.empty()) list_lines(context, own.cache);
  const auto outcome = own.fetcher.fetch(
      number, static_cast<std::uint32_t>(context.lines.size()), operation.kind,
      [&](std::uint32_t i) { return context.lines[i]; }, now);
  if (!outcome.complete) {
    park(number, now);
    occupy_missed(outcome.port_cycles, now);
    return;
  }
  context.lines.clear();
  context.phase = Phase::kIssued;
  occupy(number, 0, own.cache.hit_latency() + operation.latency,
         std::max<Cycles>(operation.port_cycles, outcome.port_cycles), now);
}

// Nobody waits for the lines; only a cache without room holds the unit up.
void ElasticUnit::issue_write(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  const MemoryOperation& operation = operation_of(context);
  const Address first = context.chain->steps[context.chain->next].record.address;
  if (!modify_all(caches_[operation.cache]->cache, first, operation, number, context.bytes_done,
                  now)) {
    park(number, now);
    occupy_missed(1, now);
    return;
  }
  context.num_accesses = 1;
  context.phase = Phase::kIssued;
  occupy(number, 0, 1 + operation.latency, operation.port_cycles, now);
}

void ElasticUnit::list_lines(Context& context, const PrivateCache& cache) {
  const MemoryOperation& operation = operation_of(context);
  const auto& steps = context.chain->steps;
  std::size_t i = context.chain->next;
  do {
    add_lines(steps[i].record.address, operation.bytes, cache, context.lines);
    ++i;
  } while (i != steps.size() && steps[i].record.continues);
  context.num_accesses = i - context.chain->next;
  keep_each_once(context.lines);
}

bool ElasticUnit::finish_step(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  for (; context.num_accesses > 1; --context.num_accesses)
    schedule_.leave_step(*context.chain, now);
  const bool calls = operation_of(context).calls;
  if (calls) context.phase = Phase::kCalled;
  schedule_.step_done(*context.chain, *this, number, now);
  return !calls && leave_step(number, now);
}

void ElasticUnit::end_chain(int number, std::uint64_t record, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  ReplayChain& chain = *context.chain;
  context.chain = nullptr;
  context.phase = Phase::kIdle;
  context.free_at = now + layout_.streams[stream_].turnaround;
  ++num_free_;
  schedule_.chain_ended(chain, record, now);
  inbox_.set_next(std::min(inbox_.next(), flush_if_due(now)));
  ReplayChain* const next = schedule_.next_waiting(stream_);
  if (next != nullptr) begin(number, *next, now);
}

Cycles ElasticUnit::flush_if_due(Cycles now) {
  const bool due =
      !layout_.streams[stream_].awaited && schedule_.all_done() && (flushing_ || is_quiet());
  return due ? flush_next(now) : kNever;
}

Cycles ElasticUnit::flush_next(Cycles now) {
  if (!flushing_) {
    flushing_ = true;
    for (auto& own : caches_) {
      for (const std::uint64_t line : own->cache.take_dirty_lines()) dirty_lines_.push_back(line);
    }
  }
  if (dirty_lines_.empty() || !caches_.front()->cache.can_write()) return kNever;
  caches_.front()->cache.write_back(dirty_lines_.back(), now);
  dirty_lines_.pop_back();
  return now + 1;
}

}  // namespace sheaf
