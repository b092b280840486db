// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "units/line_fetcher.h"
#include "units/multi_context_unit.h"
#include "units/replay_schedule.h"

namespace sheaf {

/// One private cache of a replayed unit with its end of the links.
struct ReplayedCache {
  ReplayedCache(const CacheSpec& spec, TimedOut<LineRequest>& requests, std::uint16_t requester,
                TimedIn<LineResponse>& link)
      : cache(spec, requests, requester), fetcher(cache), lines(link) {}
  PrivateCache cache;
  LineFetcher fetcher;
  TimedIn<LineResponse>& lines;
};

/// A unit of an elastic replay: its contexts go through their recorded chains of steps, on the same
/// issue port, caches and MSHRs as in a live machine. A chain begins its recorded gap after its
/// cause is done, once its context is free; a step is issued when the one before it is done. A unit
/// that nobody waits for (the film) adds to lines instead of waiting for them, and in the end
/// writes them back.
class ElasticUnit final : public MultiContextUnit<ElasticUnit>, public ReplayedUnit {
 public:
  ElasticUnit(const sc_core::sc_module_name& name, const MemoryLayout& layout, std::size_t stream,
              MemoryStream records, ReplaySchedule& schedule, ClockDomain& domain);

  /// In the order of the stream's caches, all of them before the simulation starts.
  void add_cache(const CacheSpec& spec, TimedOut<LineRequest>& requests, std::uint16_t requester,
                 TimedIn<LineResponse>& lines);
  /// Reads the first chains, once all units have been added to the schedule.
  void begin() { read_ahead(0); }

  void cause_done(int context, Cycles done) override;
  void answered(int context, Cycles at) override;
  void all_done(Cycles now) override;

  [[nodiscard]] const PrivateCache& cache(std::size_t i) const { return caches_[i]->cache; }
  /// All its chains have ended, and nothing is on its way.
  [[nodiscard]] bool is_finished() const;
  [[nodiscard]] std::size_t agent() const { return inbox_.agent(); }

 private:
  friend class MultiContextUnit<ElasticUnit>;
  /// Records held at least, unless the stream ends: far more than between a chain's place in the
  /// stream and that of its cause's doing.
  static constexpr std::size_t kAhead = std::size_t{1} << 15;
  enum class Phase : std::uint8_t { kIdle, kAwaitingCause, kBegin, kStep, kIssued, kCalled };
  struct Step {
    MemoryRecord record;
    std::uint64_t number = 0;
  };
  struct Context {
    std::deque<Step> steps;            ///< read and not done yet
    std::deque<ChainStart> chains;     ///< of these, the running one included
    std::vector<std::uint64_t> lines;  ///< of the step that has been issued
    std::size_t num_accesses = 0;      ///< of that step
    Phase phase = Phase::kIdle;
    Cycles free_at = 0;  ///< the next chain begins no earlier
  };

  Cycles accept_inputs(Cycles now);
  void ready(int context, Cycles now);
  void issue(int context, Cycles now);
  [[nodiscard]] static Cycles earliest_input() { return 0; }
  static QuickStep step_if_hit(int /*context*/, Cycles /*now*/) { return {}; }

  void read_ahead(Cycles now);
  void await_next_chain(int context, Cycles earliest);
  void begin_chain(int context, Cycles cause_done, Cycles earliest);
  bool read_some();
  bool have_step(Context& context);
  void go_on(int context);
  void leave_step(int context, Cycles now);
  void list_lines(Context& context, const PrivateCache& cache);
  void issue_writes(int context, Cycles now);
  void finish_step(int context, Cycles now);
  void end_chain(int context, std::uint64_t record, Cycles now);
  Cycles flush_next(Cycles now);

  const MemoryLayout& layout_;
  const std::size_t stream_;
  MemoryStream records_;
  ReplaySchedule& schedule_;
  std::vector<std::unique_ptr<ReplayedCache>> caches_;
  std::vector<Context> contexts_;
  std::size_t num_held_steps_ = 0;
  bool all_read_ = false;
  bool flushing_ = false;
  std::vector<std::uint64_t> dirty_lines_;
};

}  // namespace sheaf
