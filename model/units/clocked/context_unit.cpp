// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/context_unit.h"

#include <algorithm>
#include <bit>

namespace sheaf::clocked {

ContextUnit::ContextUnit(std::string name, const UnitSpec& spec, std::uint32_t packet_size)
    : Unit(std::move(name)),
      spec_(spec),
      slots_per_step_((packet_size + spec.lanes - 1) / spec.lanes),
      contexts_(spec.contexts) {}

StallCause ContextUnit::act(Cycles now) {
  const int num_contexts = static_cast<int>(contexts_.size());
  accept(now);
  for (int i = 0; i < num_contexts; ++i) {
    if (of(i).state == State::kBlocked) resume(i, now);
  }
  for (int i = 0; i < num_contexts; ++i) {
    if (of(i).state == State::kWaiting && of(i).due == now) resume(i, now);
  }
  if (!queue_.empty() && port_free_ <= now) {
    const int context = queue_.front();
    queue_.pop_front();
    issue(context, now);
  }
  return now < busy_until_ ? StallCause::kBusy : waiting_cause();
}

bool ContextUnit::any(State state) const {
  return std::any_of(contexts_.begin(), contexts_.end(),
                     [&](const Context& context) { return context.state == state; });
}

bool ContextUnit::has_free_context() const {
  return any(State::kFree);
}

StallCause ContextUnit::waiting_cause() const {
  if (any(State::kBlocked)) return StallCause::kBlockedOutput;
  if (any(State::kParked)) return StallCause::kWaitingMemory;
  const bool holds = std::any_of(contexts_.begin(), contexts_.end(), [](const Context& context) {
    return context.state != State::kFree;
  });
  return holds ? StallCause::kWaitingInput : StallCause::kIdle;
}

int ContextUnit::take_context(Cycles now) {
  const auto found = std::find_if(contexts_.begin(), contexts_.end(), [](const Context& context) {
    return context.state == State::kFree;
  });
  const int context = static_cast<int>(found - contexts_.begin());
  ++pipeline_stats_.num_accepted;
  wait_until(context, now);
  return context;
}

void ContextUnit::wait_until(int context, Cycles time) {
  of(context).state = State::kWaiting;
  of(context).due = time;
}

void ContextUnit::enqueue(int context) {
  of(context).state = State::kQueued;
  queue_.push_back(context);
}

void ContextUnit::take_port(Cycles cycles, Cycles now) {
  port_free_ = now + cycles;
  pipeline_stats_.issue_slots += cycles;
  ++pipeline_stats_.num_issues;
}

void ContextUnit::occupy(int context, Cycles cycles, Cycles latency, Cycles now) {
  take_port(cycles, now);
  const Cycles done = port_free_ - 1 + latency;
  busy_until_ = std::max(busy_until_, done);
  wait_until(context, done);
}

bool ContextUnit::fetch(int context, Cache& cache, const std::vector<std::uint64_t>& lines,
                        DataKind kind, Cycles now) {
  Context& step = of(context);
  const std::size_t first = step.next_line;
  bool has_room = true;
  while (has_room && step.next_line < lines.size()) {
    const auto result = cache.read(lines[step.next_line], kind, context, now);
    has_room = result != Cache::Result::kNoRoom;
    if (result == Cache::Result::kPending) ++step.num_pending;
    if (has_room) ++step.next_line;
  }
  const std::size_t looked_up = step.next_line - first + (has_room ? 0 : 1);
  lookup_cycles_ = cache.port_cycles(std::span(lines).subspan(first, looked_up));
  if (step.next_line == lines.size() && step.num_pending == 0) {
    step.next_line = 0;
    return true;
  }
  step.state = State::kParked;
  take_port(std::max(spec_.initiation_interval, lookup_cycles_), now);
  busy_until_ = std::max(busy_until_, port_free_);
  return false;
}

void ContextUnit::take_lines(Cache& cache, Cycles now) {
  while (cache.has_response(now)) {
    const Cache::Arrival arrival = cache.take_response(now);
    for (int i = 0; i < static_cast<int>(contexts_.size()); ++i) {
      const bool of_line = (arrival.of_line >> i & 1U) != 0;
      const bool of_room = (arrival.of_room >> i & 1U) != 0;
      if (of_line) --of(i).num_pending;
      if ((of_line || of_room) && of(i).num_pending == 0) {
        ++pipeline_stats_.num_reissues;
        wait_until(i, now);
      }
    }
  }
}

}  // namespace sheaf::clocked
