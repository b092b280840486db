// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/object_pool.h"
#include "tracefile/memory_stream.h"

namespace sheaf {

struct ReplayStep {
  MemoryRecord record;
  std::uint64_t number = 0;  ///< in its stream
};

/// What one context of a unit did from taking in a packet or a job to being done with it.
struct ReplayChain {
  ChainStart start;
  std::size_t stream = 0;
  std::vector<ReplayStep> steps;       ///< as far as they have been read
  std::size_t next = 0;                ///< steps before this one are done
  ReplayChain* next_waiter = nullptr;  ///< for the same cause
};

/// Reads the chains of a stream of a memory trace, somewhat ahead of what is being done.
class ChainReader {
 public:
  using OnChain = std::function<void(ReplayChain&)>;

  ChainReader(MemoryStream records, std::size_t stream, ObjectPool<ReplayChain>& pool)
      : records_(std::move(records)), stream_(stream), pool_(pool), open_(64) {}

  /// Reads what was recorded up to this cycle; calls on_chain for each chain that begins. Throws
  /// Error(kTrace) if the trace is not as it should be.
  void read_until(Cycles recorded, const OnChain& on_chain);
  /// Whether the chain has another step, for which it may have to be read.
  bool has_step(const ReplayChain& chain, const OnChain& on_chain);
  /// The chain's next step is done.
  void leave_step(ReplayChain& chain) {
    ++chain.next;
    --num_held_;
  }
  /// No chain of an earlier epoch is still to be read.
  [[nodiscard]] std::uint64_t next_epoch() const { return next_epoch_; }
  /// Everything has been read and done.
  [[nodiscard]] bool all_done() const { return next_epoch_ == kNoEpoch && num_held_ == 0; }
  static constexpr std::uint64_t kNoEpoch = ~std::uint64_t{0};

 private:
  bool read_step(const OnChain& on_chain);
  void look_ahead();

  MemoryStream records_;
  const std::size_t stream_;
  ObjectPool<ReplayChain>& pool_;
  std::vector<ReplayChain*> open_;  ///< by recorded context: the chain without end so far
  std::size_t num_held_ = 0;
  std::uint64_t next_epoch_ = 0;  ///< kNoEpoch: everything has been read
};

}  // namespace sheaf
