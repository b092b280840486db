// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/access_cause.h"
#include "tracefile/memory_block.h"
#include "tracefile/trace_writer.h"

namespace sheaf {

class MemoryRecorder;

/// Takes down what one unit does: chains of steps of its contexts, as the unit issues them.
/// Calls come in order of the unit's time; `now` is its own.
class StreamRecorder {
 public:
  /// The contexts of all units that can do the same work.
  struct Group {
    std::uint32_t contexts = 0;
    std::uint32_t busy = 0;
    Cycles last_full = 0;  ///< when one of them became free after all had been busy
    bool was_full = false;
  };

  StreamRecorder(MemoryRecorder& recorder, std::uint16_t number, const MemoryTraceStream& stream,
                 Group& group)
      : recorder_(recorder),
        number_(number),
        turnaround_(stream.turnaround),
        awaited_(stream.awaited),
        group_(group) {}

  /// The number of the operation that the unit knows by `key`, a small number; make() describes it
  /// when it is first asked for.
  template <typename Make>
  [[nodiscard]] std::uint32_t operation(std::size_t key, const Make& make) {
    if (key < known_.size() && known_[key] != kUnknown) return known_[key];
    return learn(key, make());
  }

  /// A context takes in a packet or job that has arrived. `earliest`: when it could have if it had
  /// not had to queue.
  void begin(int context, const AccessCause& cause, Cycles earliest, Cycles now);

  /// A step of one access, or of none; its first look-up. `last`: of its chain.
  void step(int context, std::uint32_t operation, Address address, bool last, Cycles now) {
    if (block_.records.size() >= kBlockRecords) flush();
    Context& state = contexts_[static_cast<std::size_t>(context)];
    if (state.begins) block_.chains.push_back(state.start);
    add(context,
        {address, now, operation, static_cast<std::uint8_t>(context), state.begins, last, false});
    state.begins = false;
  }
  /// One more access of the step before; of the same context and cycle.
  void also(int context, std::uint32_t operation, Address address, Cycles now) {
    add(context, {address, now, operation, static_cast<std::uint8_t>(context), false, false, true});
  }

  /// The context's last step is done, and what comes of it sets out.
  void set_out(int context, Cycles now) { contexts_[static_cast<std::size_t>(context)].sent = now; }
  /// What that was, as a cause.
  [[nodiscard]] AccessCause cause(int context) const {
    const Context& state = contexts_[static_cast<std::size_t>(context)];
    return {state.last, state.sent, state.sent, number_, false};
  }
  /// The context is free again. Returns that as a cause.
  AccessCause end(int context, Cycles now);

  void flush();
  [[nodiscard]] std::uint16_t number() const { return number_; }
  [[nodiscard]] MemoryRecorder& recorder() { return recorder_; }

 private:
  static constexpr std::size_t kBlockRecords = std::size_t{1} << 16;
  static constexpr std::uint32_t kUnknown = ~std::uint32_t{0};
  struct Context {
    std::uint64_t last = 0;  ///< number of its last record
    Cycles sent = 0;
    bool begins = false;  ///< its next record begins a chain
    ChainStart start;     ///< of that chain
  };
  void add(int context, const MemoryRecord& record) {
    block_.records.push_back(record);
    contexts_[static_cast<std::size_t>(context)].last = num_records_++;
  }
  std::uint32_t learn(std::size_t key, const MemoryOperation& operation);

  MemoryRecorder& recorder_;
  const std::uint16_t number_;
  const Cycles turnaround_;
  const bool awaited_;
  Group& group_;
  std::array<Context, 64> contexts_{};
  MemoryBlock block_;
  std::uint64_t num_records_ = 0;
  std::vector<std::uint32_t> known_;  ///< operations by the unit's key
};

/// Takes down a memory trace: every access of the units to their private caches, and what each had
/// to wait for, so that it can be replayed on other caches and another memory. Holds 64 Ki records
/// of each unit at most, whatever the length of the run.
class MemoryRecorder {
 public:
  explicit MemoryRecorder(TraceWriter& writer) : writer_(writer) {}

  /// All units, before any of them records.
  StreamRecorder& add_stream(const MemoryTraceStream& stream);
  [[nodiscard]] StreamRecorder& stream(std::size_t number) { return *streams_[number]; }
  void set_answer_latency(Cycles latency) { layout_.answer_latency = latency; }

  /// Nothing is going on at the moment but in units that nobody waits for, and something is about
  /// to begin: a new tile, or the packets of a sweep. Returns that as a cause.
  AccessCause begin_epoch(Cycles now);
  [[nodiscard]] AccessCause all_earlier(Cycles now) const {
    return {0, last_end_, now, AccessCause::kAllEarlier, false};
  }
  /// Rays have retired: the cause of what waited for room in the loop.
  void retire(const AccessCause& cause) { last_retired_ = cause; }
  [[nodiscard]] const AccessCause& last_retired() const { return last_retired_; }

  // Contributions on their way to the film, one cause a batch.
  void send_to_film(const AccessCause& cause) { to_film_.push_back(cause); }
  AccessCause arrive_at_film() {
    const AccessCause cause = to_film_.front();
    to_film_.pop_front();
    return cause;
  }

  /// Writes what is still held.
  void flush();
  [[nodiscard]] const MemoryLayout& layout() const { return layout_; }

 private:
  friend class StreamRecorder;

  TraceWriter& writer_;
  MemoryLayout layout_;
  std::vector<std::unique_ptr<StreamRecorder>> streams_;
  std::map<std::string, StreamRecorder::Group> groups_;
  std::uint64_t epoch_ = 0;
  Cycles last_end_ = 0;  ///< of the chains of awaited streams
  AccessCause last_retired_;
  std::deque<AccessCause> to_film_;
};

}  // namespace sheaf
