// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "units/clocked/cache.h"
#include "units/clocked/unit.h"
#include "units/multi_context_unit.h"

namespace sheaf::clocked {

/// The skeleton of the traversal, intersection and shader units: contexts that take turns on one
/// issue port. In every cycle the unit, in this order,
///
///  1. takes in what has arrived (accept);
///  2. lets the contexts that a full link held up try again, the lowest first (resume);
///  3. lets the contexts whose time has come go on, the lowest first (resume);
///  4. issues the step of the context that has queued longest, if the port is free (issue).
class ContextUnit : public Unit {
 public:
  [[nodiscard]] const PipelineStats& pipeline_stats() const { return pipeline_stats_; }

 protected:
  ContextUnit(std::string name, const UnitSpec& spec, std::uint32_t packet_size);

  virtual void accept(Cycles now) = 0;
  virtual void resume(int context, Cycles now) = 0;
  virtual void issue(int context, Cycles now) = 0;

  [[nodiscard]] bool has_free_context() const;
  /// The lowest free context, which goes on in this cycle.
  int take_context(Cycles now);

  // What becomes of a context.
  void free(int context) { of(context).state = State::kFree; }
  void block(int context) { of(context).state = State::kBlocked; }
  void await(int context) { of(context).state = State::kAwaiting; }
  void wait_until(int context, Cycles time);
  void enqueue(int context);

  /// A step takes the port for `cycles`, and is done `latency` after its last one.
  void occupy(int context, Cycles cycles, Cycles latency, Cycles now);
  /// Looks up the lines of a context's step that it has not asked for yet. If all are there, true.
  /// Else the step takes the port for one initiation interval, or while it looks up, and is to be
  /// issued again when take_lines() has brought the last of them.
  bool fetch(int context, Cache& cache, const std::vector<std::uint64_t>& lines, DataKind kind,
             Cycles now);
  /// Cycles that the last fetch() took of the cache's ports.
  [[nodiscard]] Cycles lookup_cycles() const { return lookup_cycles_; }
  void take_lines(Cache& cache, Cycles now);

  const UnitSpec spec_;
  const std::uint32_t slots_per_step_;

 private:
  StallCause act(Cycles now) final;
  enum class State : std::uint8_t { kFree, kWaiting, kQueued, kAwaiting, kParked, kBlocked };
  struct Context {
    State state = State::kFree;
    Cycles due = 0;               ///< kWaiting: when to go on
    std::size_t next_line = 0;    ///< of a step: lines before this one have been asked for
    std::size_t num_pending = 0;  ///< of those, still on their way
  };
  [[nodiscard]] Context& of(int context) { return contexts_[static_cast<std::size_t>(context)]; }
  void take_port(Cycles cycles, Cycles now);
  [[nodiscard]] bool any(State state) const;
  [[nodiscard]] StallCause waiting_cause() const;

  std::vector<Context> contexts_;
  std::deque<int> queue_;  ///< for the issue port
  Cycles port_free_ = 0;
  Cycles busy_until_ = 0;
  Cycles lookup_cycles_ = 0;
  PipelineStats pipeline_stats_;
};

}  // namespace sheaf::clocked
