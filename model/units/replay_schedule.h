// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <queue>
#include <vector>

#include "channels/clock_domain.h"
#include "units/replay_chain.h"
#include "units/step_window.h"

namespace sheaf {

/// A unit in an elastic replay, as the schedule sees it.
class ReplayedUnit {
 public:
  virtual ~ReplayedUnit() = default;
  [[nodiscard]] virtual std::size_t num_free_contexts() const = 0;
  /// One of its free contexts begins this chain, at this cycle or once it can.
  virtual void assign(ReplayChain& chain, Cycles at) = 0;
  /// The chain that a context's step called has ended; it goes on at this cycle.
  virtual void answered(int context, std::uint64_t record, Cycles at) = 0;
  /// Nothing is left to be done by units that others wait for.
  virtual void all_done(Cycles now) = 0;
};

/// Lets the chains of a trace begin when what they waited for is done, each on the unit of its
/// group with the most free contexts, or on the first one that gets a context free; of chains that
/// wait for one, the first to have begun in the recording goes first, so that the choices of the
/// arbiter are kept.
class ReplaySchedule final : public Agent {
 public:
  ReplaySchedule(const MemoryLayout& layout, ClockDomain& domain);

  /// The unit of the stream, and its records. All of them, in order, before the simulation.
  void add(ReplayedUnit& unit, MemoryStream records);
  /// Reads the first chains.
  void begin();

  // By a unit, of a chain that it has been assigned:
  /// Whether there is another step.
  [[nodiscard]] bool has_step(ReplayChain& chain, Cycles now);
  /// The next step is done, by this unit's context; what waited for it begins.
  void step_done(ReplayChain& chain, ReplayedUnit& unit, int context, Cycles now);
  /// That step is answered, if it called, and left behind.
  void leave_step(ReplayChain& chain, Cycles now);
  /// The last step has been left behind; `record` is its number. The unit's context is free.
  void chain_ended(ReplayChain& chain, std::uint64_t record, Cycles now);
  /// The first of the chains that wait for a context of the unit of this stream; null if none does.
  [[nodiscard]] ReplayChain* next_waiting(std::size_t stream);

  /// All chains of awaited streams have ended.
  [[nodiscard]] bool is_finished() const { return epoch_ == kNoEpoch; }
  /// And all others, too.
  [[nodiscard]] bool all_done() const;

  Cycles wake(Cycles now) override;
  [[nodiscard]] std::size_t agent() const { return agent_; }

 private:
  /// Cycles of the recording that are read ahead: fewer steps than are remembered, more than lie
  /// between a chain's beginning and that of what it waits for.
  static constexpr Cycles kAhead = Cycles{1} << 15;
  static constexpr std::uint64_t kNoEpoch = ChainReader::kNoEpoch;
  struct Stream {
    ReplayedUnit* unit = nullptr;
    std::unique_ptr<ChainReader> reader;
    std::size_t group = 0;
    bool awaited = true;
    StepWindow steps{1, 1};  ///< as large as the stream's records need, once it has any
    std::map<std::uint64_t, std::uint64_t> epochs;  ///< chains not ended yet, by epoch
  };
  struct Arrival {
    Cycles at = 0;
    std::uint64_t rank = 0;
    ReplayChain* chain = nullptr;
    bool operator>(const Arrival& other) const {
      return at != other.at ? at > other.at : rank > other.rank;
    }
  };
  using Arrivals = std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>>;
  struct Group {
    std::vector<std::size_t> streams;
    Arrivals waiting;  ///< for a context; by the cycle in which they began in the recording
  };

  void read_ahead(Cycles recorded, Cycles now);
  void take_in(ReplayChain& chain, Cycles now);
  void await(ReplayChain& chain, Cycles now);
  void tell_waiters(StepState& step, bool ended, Cycles now);
  void arrive(ReplayChain& chain, Cycles done, Cycles now);
  void place(const Arrival& arrival);
  [[nodiscard]] std::uint64_t first_epoch(const Stream& stream) const;
  void advance_epoch(Cycles now);

  const MemoryLayout& layout_;
  ClockDomain& domain_;
  const std::size_t agent_;
  ObjectPool<ReplayChain> chains_;
  std::vector<Stream> streams_;
  std::vector<Group> groups_;
  Arrivals arriving_;
  Cycles read_until_ = 0;  ///< of the recording
  std::uint64_t num_arrived_ = 0;
  std::uint64_t epoch_ = 0;  ///< all chains of earlier ones have ended,
  Cycles epoch_begin_ = 0;   ///< at this cycle
  Cycles last_end_ = 0;      ///< of any awaited chain
  std::vector<ReplayChain*> epoch_waiters_;
};

}  // namespace sheaf
