// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "units/line_fetcher.h"
#include "units/multi_context_unit.h"
#include "units/replay_schedule.h"

namespace sheaf {

/// A unit of an elastic replay: its contexts go through recorded chains of steps, on the same issue
/// port, caches and MSHRs as in a live machine. A step is issued when the one before it is done. A
/// unit that nobody waits for (the film) adds to lines instead of waiting for them, and in the end
/// writes them back.
class ElasticUnit final : public MultiContextUnit<ElasticUnit>, public ReplayedUnit {
 public:
  ElasticUnit(const sc_core::sc_module_name& name, const MemoryLayout& layout, std::size_t stream,
              ReplaySchedule& schedule, ClockDomain& domain);

  /// In the order of the stream's caches, all of them before the simulation starts.
  void add_cache(const CacheSpec& spec, TimedOut<LineRequest>& requests, std::uint16_t requester,
                 TimedIn<LineResponse>& lines);

  [[nodiscard]] std::size_t num_free_contexts() const override { return num_free_; }
  void assign(ReplayChain& chain, Cycles at) override;
  void answered(int context, std::uint64_t record, Cycles at) override;
  void all_done(Cycles now) override;

  [[nodiscard]] const PrivateCache& cache(std::size_t i) const { return caches_[i]->cache; }
  /// No line is on its way to it.
  [[nodiscard]] bool is_quiet() const;
  [[nodiscard]] std::size_t agent() const { return inbox_.agent(); }

 private:
  friend class MultiContextUnit<ElasticUnit>;
  enum class Phase : std::uint8_t { kIdle, kBegin, kStep, kIssued, kCalled, kAnswered };
  struct Context {
    ReplayChain* chain = nullptr;
    std::vector<std::uint64_t> lines;  ///< that the step in hand asks for
    std::size_t num_accesses = 0;      ///< of that step
    Bytes bytes_done = 0;              ///< of a write
    Phase phase = Phase::kIdle;
    Cycles free_at = 0;  ///< the next chain begins no earlier
  };
  struct Cache {
    Cache(const CacheSpec& spec, TimedOut<LineRequest>& requests, std::uint16_t requester,
          TimedIn<LineResponse>& link)
        : cache(spec, requests, requester), fetcher(cache), lines(link) {}
    PrivateCache cache;
    LineFetcher fetcher;
    TimedIn<LineResponse>& lines;
  };

  Cycles accept_inputs(Cycles now);
  bool ready(int context, Cycles now);
  void issue(int context, Cycles now);
  [[nodiscard]] static Cycles earliest_input() { return 0; }

  [[nodiscard]] const MemoryOperation& operation_of(const Context& context) const {
    return layout_.operations[context.chain->steps[context.chain->next].record.operation];
  }
  void begin(int context, ReplayChain& chain, Cycles at);
  void list_lines(Context& context, const PrivateCache& cache);
  void issue_write(int context, Cycles now);
  bool finish_step(int context, Cycles now);
  bool leave_step(int context, Cycles now);
  bool begin_step(int context, Cycles now);
  void end_chain(int context, std::uint64_t record, Cycles now);
  /// Once everything has been replayed, one modified line; returns when the next one can be.
  Cycles flush_if_due(Cycles now);
  Cycles flush_next(Cycles now);

  const MemoryLayout& layout_;
  const std::size_t stream_;
  ReplaySchedule& schedule_;
  std::vector<std::unique_ptr<Cache>> caches_;
  std::vector<Context> contexts_;
  std::size_t num_free_;
  std::vector<std::uint64_t> dirty_lines_;
  bool flushing_ = false;
};

}  // namespace sheaf
