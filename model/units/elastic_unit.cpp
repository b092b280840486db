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
                         std::size_t stream, MemoryStream records, ReplaySchedule& schedule,
                         ClockDomain& domain)
    : MultiContextUnit(name, spec_of(layout.streams[stream]), 1, domain),
      layout_(layout),
      stream_(stream),
      records_(std::move(records)),
      schedule_(schedule),
      contexts_(layout.streams[stream].contexts) {
  schedule.add(*this);
}

void ElasticUnit::add_cache(const CacheSpec& spec, TimedOut<LineRequest>& requests,
                            std::uint16_t requester, TimedIn<LineResponse>& lines) {
  caches_.push_back(std::make_unique<ReplayedCache>(spec, requests, requester, lines));
  caches_.back()->cache.bind(inbox_);
  lines.set_consumer(inbox_);
}

// One record more; false at the end of the stream, or if it cannot be read: an exception has
// nowhere to go from within a simulation.
bool ElasticUnit::read_some() try {
  const MemoryRecord* record = records_.peek();
  all_read_ = record == nullptr;
  if (all_read_) return false;
  Context& context = contexts_[record->context];
  context.steps.push_back({*record, records_.number()});
  ++num_held_steps_;
  if (record->begins) {
    context.chains.push_back(records_.chain());
    schedule_.read_chain(stream_, records_.chain().epoch);
  }
  records_.pop();
  return true;
} catch (...) {
  schedule_.errors().fail(std::current_exception());
  domain_.stop();
  all_read_ = true;
  return false;
}

void ElasticUnit::read_ahead(Cycles now) {
  if (all_read_ || num_held_steps_ >= kAhead) return;
  while (num_held_steps_ < 2 * kAhead && read_some()) {
  }
  schedule_.have_read(stream_, all_read_, now);
  for (std::size_t i = 0; i < contexts_.size(); ++i) {
    await_next_chain(static_cast<int>(i), now);
  }
}

// Other contexts may hold all that has been read.
bool ElasticUnit::have_step(Context& context) {
  while (context.steps.empty() && read_some()) {
  }
  return !context.steps.empty();
}

void ElasticUnit::await_next_chain(int number, Cycles earliest) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  if (context.phase != Phase::kIdle || context.chains.empty()) return;
  context.phase = Phase::kAwaitingCause;
  const Cycles done = schedule_.await(context.chains.front(), stream_, number);
  if (done != kNever) begin_chain(number, done, earliest);
}

void ElasticUnit::cause_done(int number, Cycles done) {
  begin_chain(number, done, domain_.now() + 1);
}

void ElasticUnit::begin_chain(int number, Cycles done, Cycles earliest) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  if (context.phase != Phase::kAwaitingCause) return;
  const Cycles gap = std::max<Cycles>(1, context.chains.front().gap);
  const Cycles at = std::max({done + gap, context.free_at, earliest});
  context.phase = Phase::kBegin;
  schedule(number, at);
  inbox_.nudge(at);
}

void ElasticUnit::answered(int number, Cycles at) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  if (context.phase != Phase::kCalled) return;
  schedule(number, at);
  inbox_.nudge(at);
}

void ElasticUnit::all_done(Cycles now) {
  if (!layout_.streams[stream_].awaited) inbox_.expect(now + 1);
}

bool ElasticUnit::is_finished() const {
  return all_read_ && num_held_steps_ == 0 &&
         std::ranges::none_of(caches_, [](const auto& own) { return own->cache.has_pending(); });
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
  if (!awaited && schedule_.is_finished() && is_finished()) next = std::min(next, flush_next(now));
  return next;
}

void ElasticUnit::ready(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  switch (context.phase) {
    case Phase::kIdle:
    case Phase::kAwaitingCause:
      return;
    case Phase::kBegin:
      go_on(number);
      return;
    case Phase::kStep:
      enqueue(number);
      return;
    case Phase::kIssued:
      finish_step(number, now);
      return;
    case Phase::kCalled:
      leave_step(number, now);
      return;
  }
}

void ElasticUnit::go_on(int number) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  context.phase = Phase::kStep;
  if (have_step(context)) {
    enqueue(number);
  } else {
    context.phase = Phase::kIdle;  // a chain without end: the replay will not come to its own
  }
}

// Its step is done, and answered if it called.
void ElasticUnit::leave_step(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  const Step step = context.steps.front();
  context.steps.pop_front();
  --num_held_steps_;
  if (step.record.ends) {
    end_chain(number, step.number, now);
  } else {
    go_on(number);
  }
  read_ahead(now);
}

void ElasticUnit::issue(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  const MemoryOperation& operation = layout_.operations[context.steps.front().record.operation];
  if (operation.bytes == 0) {
    context.num_accesses = 1;
    context.phase = Phase::kIssued;
    occupy(number, 0, operation.latency, operation.port_cycles, now);
    return;
  }
  ReplayedCache& own = *caches_[operation.cache];
  if (context.lines.empty()) list_lines(context, own.cache);
  if (operation.write) {
    issue_writes(number, now);
    return;
  }
  const auto outcome = own.fetcher.fetch(
      number, static_cast<std::uint32_t>(context.lines.size()), operation.kind,
      [&](std::uint32_t i) { return context.lines[i]; }, now);
  if (!outcome.complete) {
    park(number, now);
    occupy_missed(outcome.lookups, now);
    return;
  }
  context.lines.clear();
  context.phase = Phase::kIssued;
  occupy(number, 0, own.cache.hit_latency() + operation.latency,
         std::max<Cycles>(operation.port_cycles, outcome.lookups), now);
}

// Nobody waits for the lines; only a lack of MSHRs holds the unit up.
void ElasticUnit::issue_writes(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  const MemoryOperation& operation = layout_.operations[context.steps.front().record.operation];
  PrivateCache& cache = caches_[operation.cache]->cache;
  while (!context.lines.empty()) {
    if (cache.modify(context.lines.back(), operation.kind, number, now) ==
        PrivateCache::Result::kNoMshr) {
      park(number, now);
      occupy_missed(1, now);
      return;
    }
    context.lines.pop_back();
  }
  context.phase = Phase::kIssued;
  occupy(number, 0, 1 + operation.latency, operation.port_cycles, now);
}

void ElasticUnit::list_lines(Context& context, const PrivateCache& cache) {
  const MemoryOperation& operation = layout_.operations[context.steps.front().record.operation];
  context.num_accesses = 0;
  for (const Step& step : context.steps) {
    if (context.num_accesses != 0 && !step.record.continues) break;
    add_lines(step.record.address, operation.bytes, cache, context.lines);
    ++context.num_accesses;
  }
  keep_each_once(context.lines);
  if (operation.write) std::ranges::reverse(context.lines);  // taken from the end
}

void ElasticUnit::finish_step(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  for (; context.num_accesses > 1; --context.num_accesses) {
    context.steps.pop_front();
    --num_held_steps_;
  }
  const Step last = context.steps.front();
  schedule_.step_done(stream_, last.number, number, now);
  if (layout_.operations[last.record.operation].calls) {
    context.phase = Phase::kCalled;
  } else {
    leave_step(number, now);
  }
}

void ElasticUnit::end_chain(int number, std::uint64_t record, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  const ChainStart chain = context.chains.front();
  context.chains.pop_front();
  context.phase = Phase::kIdle;
  context.free_at = now + layout_.streams[stream_].turnaround;
  schedule_.chain_ended(stream_, record, chain, now);
  await_next_chain(number, now);
}

Cycles ElasticUnit::flush_next(Cycles now) {
  if (!flushing_) {
    flushing_ = true;
    for (auto& own : caches_) {
      for (const std::uint64_t line : own->cache.take_dirty_lines()) dirty_lines_.push_back(line);
    }
  }
  if (dirty_lines_.empty()) return kNever;
  caches_.front()->cache.write_back(dirty_lines_.back(), now);
  dirty_lines_.pop_back();
  return now + 1;
}

}  // namespace sheaf
