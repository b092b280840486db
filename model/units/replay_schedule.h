// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <exception>
#include <map>
#include <vector>

#include "tracefile/memory_stream.h"

namespace sheaf {

/// A unit in an elastic replay, as the others see it.
class ReplayedUnit {
 public:
  virtual ~ReplayedUnit() = default;
  /// What the next chain of a context waited for was done at this cycle.
  virtual void cause_done(int context, Cycles done) = 0;
  /// The chain that a context's step called has ended; it goes on at this cycle.
  virtual void answered(int context, Cycles at) = 0;
  /// Nothing is left to be done by units that others wait for.
  virtual void all_done(Cycles now) = 0;
};

/// Error(kTrace) thrown while a trace was read in the middle of a replay, to be thrown again after
/// it: from within a simulation an exception has nowhere to go.
class ReplayErrors {
 public:
  void fail(std::exception_ptr error) {
    if (!error_) error_ = std::move(error);
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::exception_ptr error_;
};

/// Keeps account of what is done in an elastic replay, and lets chains begin whose cause is done.
/// For each stream it remembers the last kRemembered steps; what lies further back is long done.
class ReplaySchedule {
 public:
  ReplaySchedule(const MemoryLayout& layout, ReplayErrors& errors);

  /// All units, in the order of their streams.
  void add(ReplayedUnit& unit) { streams_[num_units_++].unit = &unit; }

  /// A chain has been read from the trace; those of a stream in their order.
  void read_chain(std::size_t stream, std::uint64_t epoch);
  /// So much has been read for now; `all`: of the stream.
  void have_read(std::size_t stream, bool all, Cycles now);

  /// When the cause of a chain was done, or kNever: then cause_done() will tell.
  [[nodiscard]] Cycles await(const ChainStart& chain, std::size_t stream, int context);

  /// A step is done; `record`: its last.
  void step_done(std::size_t stream, std::uint64_t record, int context, Cycles now);
  /// A chain has ended, with this record.
  void chain_ended(std::size_t stream, std::uint64_t record, const ChainStart& chain, Cycles now);

  /// All chains of awaited streams have ended.
  [[nodiscard]] bool is_finished() const { return epoch_ == kNoEpoch; }
  [[nodiscard]] ReplayErrors& errors() { return errors_; }

 private:
  static constexpr std::size_t kRemembered = std::size_t{1} << 17;
  static constexpr std::uint64_t kNoEpoch = ~std::uint64_t{0};
  struct Done {
    std::uint64_t record = ~std::uint64_t{0};
    Cycles step = kNever;   ///< when the step was done
    Cycles chain = kNever;  ///< when the chain that it ends was
    std::uint8_t context = 0;
    bool awaited = false;  ///< there are waiters for it
  };
  struct Waiter {
    std::size_t stream = 0;  ///< who waits
    int context = 0;
    ChainStart chain;
  };
  struct Stream {
    ReplayedUnit* unit = nullptr;
    bool awaited = true;
    std::vector<Done> done;                         ///< by record number modulo kRemembered
    std::map<std::uint64_t, std::uint64_t> epochs;  ///< chains not ended yet, by epoch
    std::uint64_t last_epoch = 0;                   ///< of the chain read last
    bool read = false;                              ///< all chains have been read
    std::vector<Waiter> waiters;                    ///< for records of this stream
    /// No chain of an earlier epoch is left.
    [[nodiscard]] std::uint64_t first_epoch() const;
  };
  [[nodiscard]] Done& done_at(Stream& stream, std::uint64_t record) {
    return stream.done[record % kRemembered];
  }
  void tell_waiters(Stream& stream, std::uint64_t record, bool ended, Cycles now);
  void advance_epoch(Cycles now);

  const MemoryLayout& layout_;
  std::vector<Stream> streams_;
  std::size_t num_units_ = 0;
  std::uint64_t epoch_ = 0;  ///< all chains of earlier ones have ended,
  Cycles epoch_begin_ = 0;   ///< at this cycle
  Cycles last_end_ = 0;      ///< of any awaited chain
  std::vector<Waiter> epoch_waiters_;
  ReplayErrors& errors_;
};

}  // namespace sheaf
