// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/memory_recorder.h"

#include <algorithm>
#include <utility>

namespace sheaf {
namespace {

// A chain that begins within so many cycles of a context's getting free when all had been busy has
// waited for it, and would have begun earlier if it had been free earlier.
constexpr Cycles kWaitedForContext = 16;

}  // namespace

std::uint32_t StreamRecorder::learn(std::size_t key, const MemoryOperation& operation) {
  auto& all = recorder_.layout_.operations;
  const auto found = std::ranges::find(all, operation);
  const auto number = static_cast<std::uint32_t>(found - all.begin());
  if (found == all.end()) all.push_back(operation);
  if (known_.size() <= key) known_.resize(key + 1, kUnknown);
  return known_[key] = number;
}

void StreamRecorder::begin(int context, const AccessCause& cause, Cycles earliest, Cycles now) {
  Context& state = contexts_[static_cast<std::size_t>(context)];
  const bool waited = group_.was_full && now <= group_.last_full + turnaround_ + kWaitedForContext;
  ++group_.busy;
  const Cycles begin = waited ? std::min(earliest, now) : now;
  const Cycles gap = begin > cause.done ? begin - cause.done : 1;
  state.start = {cause.stream, cause.record, cause.ended, gap, recorder_.epoch_};
  state.begins = true;
}

AccessCause StreamRecorder::end(int context, Cycles now) {
  Context& state = contexts_[static_cast<std::size_t>(context)];
  if (group_.busy == group_.contexts) {
    group_.was_full = true;
    group_.last_full = std::max(group_.last_full, now);
  }
  --group_.busy;
  state.sent = now;
  if (awaited_) recorder_.last_end_ = std::max(recorder_.last_end_, now);
  AccessCause ended = cause(context);
  ended.ended = true;
  return ended;
}

void StreamRecorder::flush() {
  if (block_.records.empty()) return;
  const auto count = static_cast<std::uint32_t>(block_.records.size());
  const auto block = std::make_shared<const MemoryBlock>(std::move(block_));
  block_ = {};
  block_.records.reserve(kBlockRecords);
  recorder_.writer_.add(memory_key(number_, num_records_ - count), count,
                        [block, operations = recorder_.layout_.operations] {
                          return encode_memory_block(*block, operations);
                        });
}

StreamRecorder& MemoryRecorder::add_stream(const MemoryTraceStream& stream) {
  const auto number = static_cast<std::uint16_t>(streams_.size());
  layout_.streams.push_back(stream);
  StreamRecorder::Group& group = groups_[stream.group];
  group.contexts += stream.contexts;
  streams_.push_back(std::make_unique<StreamRecorder>(*this, number, stream, group));
  return *streams_.back();
}

AccessCause MemoryRecorder::begin_epoch(Cycles now) {
  ++epoch_;
  return all_earlier(now);
}

void MemoryRecorder::flush() {
  for (const auto& stream : streams_) stream->flush();
}

}  // namespace sheaf
