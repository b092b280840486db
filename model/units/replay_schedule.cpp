// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/replay_schedule.h"

#include <algorithm>

namespace sheaf {

ReplaySchedule::ReplaySchedule(const MemoryLayout& layout, ReplayErrors& errors)
    : layout_(layout), streams_(layout.streams.size()), errors_(errors) {
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    streams_[i].awaited = layout.streams[i].awaited;
    streams_[i].done.resize(kRemembered);
  }
}

std::uint64_t ReplaySchedule::Stream::first_epoch() const {
  if (!awaited) return kNoEpoch;
  const std::uint64_t unread = read ? kNoEpoch : last_epoch;
  return epochs.empty() ? unread : std::min(unread, epochs.begin()->first);
}

void ReplaySchedule::read_chain(std::size_t stream, std::uint64_t epoch) {
  ++streams_[stream].epochs[epoch];
  streams_[stream].last_epoch = epoch;
}

void ReplaySchedule::have_read(std::size_t stream, bool all, Cycles now) {
  streams_[stream].read = all;
  advance_epoch(now);
}

Cycles ReplaySchedule::await(const ChainStart& chain, std::size_t stream, int context) {
  if (chain.cause_stream == AccessCause::kAllEarlier) {
    if (epoch_ >= chain.epoch) return epoch_begin_;
    epoch_waiters_.push_back({stream, context, chain});
    return kNever;
  }
  Stream& source = streams_[chain.cause_stream];
  Done& done = done_at(source, chain.cause_record);
  if (done.record == chain.cause_record) {
    const Cycles at = chain.cause_ended ? done.chain : done.step;
    if (at != kNever) return at;
  } else if (done.record != ~std::uint64_t{0} && done.record > chain.cause_record) {
    return 0;  // so long ago that a later record has taken its place
  } else {
    done = {chain.cause_record, kNever, kNever, 0, false};
  }
  done.awaited = true;
  source.waiters.push_back({stream, context, chain});
  return kNever;
}

void ReplaySchedule::tell_waiters(Stream& stream, std::uint64_t record, bool ended, Cycles now) {
  for (std::size_t i = 0; i < stream.waiters.size();) {
    const Waiter waiter = stream.waiters[i];
    if (waiter.chain.cause_record != record || waiter.chain.cause_ended != ended) {
      ++i;
      continue;
    }
    stream.waiters[i] = stream.waiters.back();
    stream.waiters.pop_back();
    streams_[waiter.stream].unit->cause_done(waiter.context, now);
  }
}

void ReplaySchedule::step_done(std::size_t number, std::uint64_t record, int context, Cycles now) {
  Stream& stream = streams_[number];
  Done& done = done_at(stream, record);
  const bool awaited = done.record == record && done.awaited;
  done = {record, now, kNever, static_cast<std::uint8_t>(context), awaited};
  if (awaited) tell_waiters(stream, record, false, now);
}

void ReplaySchedule::chain_ended(std::size_t number, std::uint64_t record, const ChainStart& chain,
                                 Cycles now) {
  Stream& stream = streams_[number];
  Done& done = done_at(stream, record);
  if (done.record == record) {
    done.chain = now;
    if (done.awaited) tell_waiters(stream, record, true, now);
  }
  // A caller waits for its answer.
  if (chain.cause_stream != AccessCause::kAllEarlier && !chain.cause_ended) {
    Stream& caller = streams_[chain.cause_stream];
    const Done& call = done_at(caller, chain.cause_record);
    if (call.record == chain.cause_record && caller.unit != nullptr) {
      caller.unit->answered(call.context, now + layout_.answer_latency);
    }
  }
  const auto epoch = stream.epochs.find(chain.epoch);
  if (epoch != stream.epochs.end() && --epoch->second == 0) stream.epochs.erase(epoch);
  if (!stream.awaited) return;
  last_end_ = std::max(last_end_, now);
  advance_epoch(now);
}

void ReplaySchedule::advance_epoch(Cycles now) {
  std::uint64_t first = kNoEpoch;
  for (const Stream& stream : streams_) first = std::min(first, stream.first_epoch());
  if (first <= epoch_) return;
  epoch_ = first;
  epoch_begin_ = last_end_;
  for (std::size_t i = 0; i < epoch_waiters_.size();) {
    const Waiter waiter = epoch_waiters_[i];
    if (waiter.chain.epoch > epoch_) {
      ++i;
      continue;
    }
    epoch_waiters_[i] = epoch_waiters_.back();
    epoch_waiters_.pop_back();
    streams_[waiter.stream].unit->cause_done(waiter.context, epoch_begin_);
  }
  if (epoch_ == kNoEpoch) {
    for (Stream& stream : streams_) stream.unit->all_done(now);
  }
}

}  // namespace sheaf
