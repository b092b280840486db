// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/replay_schedule.h"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

namespace sheaf {

ReplaySchedule::ReplaySchedule(const MemoryLayout& layout, ClockDomain& domain)
    : layout_(layout), domain_(domain), agent_(domain.add(*this)) {
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < layout.streams.size(); ++i) {
    Stream& stream = streams_.emplace_back();
    const auto known = numbers.try_emplace(layout.streams[i].group, groups_.size());
    if (known.second) groups_.emplace_back();
    stream.group = known.first->second;
    groups_[stream.group].streams.push_back(i);
    stream.awaited = layout.streams[i].awaited;
  }
}

void ReplaySchedule::add(ReplayedUnit& unit, MemoryStream records) {
  const auto is_new = [](const Stream& stream) { return stream.unit == nullptr; };
  const auto stream = std::ranges::find_if(streams_, is_new);
  stream->unit = &unit;
  const auto room_for = [&](std::size_t most) {
    return std::bit_ceil(std::clamp<std::size_t>(records.size(), 1, most));
  };
  stream->steps = StepWindow(room_for(StepWindow::kLeast), room_for(StepWindow::kMost));
  stream->reader = std::make_unique<ChainReader>(
      std::move(records), static_cast<std::size_t>(stream - streams_.begin()), chains_);
}

void ReplaySchedule::begin() {
  read_ahead(0, 0);
}

// So that half of kAhead at least lies before the cycle of the recording.
void ReplaySchedule::read_ahead(Cycles recorded, Cycles now) {
  if (recorded + kAhead / 2 < read_until_) return;
  read_until_ = recorded + kAhead;
  for (Stream& stream : streams_) {
    stream.reader->read_until(read_until_, [&](ReplayChain& chain) { take_in(chain, now); });
  }
  advance_epoch(now);
}

bool ReplaySchedule::has_step(ReplayChain& chain, Cycles now) {
  if (chain.next != chain.steps.size()) return true;
  ChainReader& reader = *streams_[chain.stream].reader;
  const bool has = reader.has_step(chain, [&](ReplayChain& read) { take_in(read, now); });
  advance_epoch(now);
  return has;
}

void ReplaySchedule::take_in(ReplayChain& chain, Cycles now) {
  Stream& stream = streams_[chain.stream];
  ++stream.epochs[chain.start.epoch];
  await(chain, now);
}

void ReplaySchedule::await(ReplayChain& chain, Cycles now) {
  const ChainStart& start = chain.start;
  if (start.cause_stream == AccessCause::kAllEarlier) {
    if (epoch_ >= start.epoch) return arrive(chain, epoch_begin_, now);
    epoch_waiters_.push_back(&chain);
    return;
  }
  StepWindow& steps = streams_[start.cause_stream].steps;
  if (steps.is_past(start.cause_record)) return arrive(chain, 0, now);
  StepState& cause = steps.at(start.cause_record);
  const Cycles at = start.cause_ended ? cause.chain_ended : cause.done;
  if (at != kNever) return arrive(chain, at, now);
  chain.next_waiter = std::exchange(cause.waiters, &chain);
}

void ReplaySchedule::tell_waiters(StepState& step, bool ended, Cycles now) {
  ReplayChain* chain = std::exchange(step.waiters, nullptr);
  while (chain != nullptr) {
    ReplayChain* const next = chain->next_waiter;
    if (chain->start.cause_ended == ended) {
      arrive(*chain, now, now);
    } else {
      chain->next_waiter = std::exchange(step.waiters, chain);
    }
    chain = next;
  }
}

// What has been learnt late cannot begin in the past: `now` is the time of the unit that acts.
void ReplaySchedule::arrive(ReplayChain& chain, Cycles done, Cycles now) {
  const Cycles gap = std::max<Cycles>(1, chain.start.gap);
  const Cycles at = std::max(done + gap, now + 1);
  arriving_.push({at, num_arrived_++, &chain});
  domain_.schedule(agent_, at - 1);
}

// Places chains the cycle before they begin, so that their unit cannot have got there yet.
Cycles ReplaySchedule::wake(Cycles now) {
  while (!arriving_.empty() && arriving_.top().at <= now + 1) {
    const Arrival arrival = arriving_.top();
    arriving_.pop();
    place(arrival);
  }
  return arriving_.empty() ? kNever : arriving_.top().at - 1;
}

void ReplaySchedule::place(const Arrival& arrival) {
  Group& group = groups_[streams_[arrival.chain->stream].group];
  const auto num_free = [&](std::size_t stream) {
    return streams_[stream].unit->num_free_contexts();
  };
  const std::size_t freest = *std::ranges::max_element(group.streams, {}, num_free);
  if (num_free(freest) == 0) {
    const Cycles recorded = arrival.chain->steps.front().record.cycle;
    group.waiting.push({recorded, arrival.rank, arrival.chain});
  } else {
    streams_[freest].unit->assign(*arrival.chain, arrival.at);
  }
}

ReplayChain* ReplaySchedule::next_waiting(std::size_t stream) {
  Arrivals& waiting = groups_[streams_[stream].group].waiting;
  if (waiting.empty()) return nullptr;
  ReplayChain* const chain = waiting.top().chain;
  waiting.pop();
  return chain;
}

void ReplaySchedule::step_done(ReplayChain& chain, ReplayedUnit& unit, int context, Cycles now) {
  StepState& step = streams_[chain.stream].steps.at(chain.steps[chain.next].number);
  step.done = now;
  step.unit = &unit;
  step.context = static_cast<std::uint8_t>(context);
  tell_waiters(step, false, now);
}

void ReplaySchedule::leave_step(ReplayChain& chain, Cycles now) {
  Stream& stream = streams_[chain.stream];
  const ReplayStep& left = chain.steps[chain.next];
  stream.steps.at(left.number).left = true;
  stream.reader->leave_step(chain);
  read_ahead(left.record.cycle, now);
}

void ReplaySchedule::chain_ended(ReplayChain& chain, std::uint64_t record, Cycles now) {
  Stream& stream = streams_[chain.stream];
  if (!stream.steps.is_past(record)) {
    StepState& last = stream.steps.at(record);
    last.chain_ended = now;
    tell_waiters(last, true, now);
  }
  // A caller waits for its answer.
  const ChainStart start = chain.start;
  if (start.cause_stream != AccessCause::kAllEarlier && !start.cause_ended) {
    StepWindow& steps = streams_[start.cause_stream].steps;
    const bool has_caller = !steps.is_past(start.cause_record);
    const StepState call = has_caller ? steps.at(start.cause_record) : StepState{};
    if (call.unit != nullptr) {
      call.unit->answered(call.context, start.cause_record, now + layout_.answer_latency);
    }
  }
  chains_.release(&chain);
  const auto epoch = stream.epochs.find(start.epoch);
  if (epoch != stream.epochs.end() && --epoch->second == 0) stream.epochs.erase(epoch);
  if (!stream.awaited) return;
  last_end_ = std::max(last_end_, now);
  advance_epoch(now);
}

// No chain of an earlier epoch is left in the stream.
std::uint64_t ReplaySchedule::first_epoch(const Stream& stream) const {
  if (!stream.awaited) return kNoEpoch;
  const std::uint64_t unread = stream.reader->next_epoch();
  return stream.epochs.empty() ? unread : std::min(unread, stream.epochs.begin()->first);
}

void ReplaySchedule::advance_epoch(Cycles now) {
  std::uint64_t first = kNoEpoch;
  for (const Stream& stream : streams_) first = std::min(first, first_epoch(stream));
  if (first <= epoch_) return;
  epoch_ = first;
  epoch_begin_ = last_end_;
  std::erase_if(epoch_waiters_, [&](ReplayChain* chain) {
    if (chain->start.epoch > epoch_) return false;
    arrive(*chain, epoch_begin_, now);
    return true;
  });
  if (epoch_ != kNoEpoch) return;
  for (Stream& stream : streams_) stream.unit->all_done(now);
}

bool ReplaySchedule::all_done() const {
  return std::ranges::all_of(streams_,
                             [](const Stream& stream) { return stream.reader->all_done(); });
}

}  // namespace sheaf
