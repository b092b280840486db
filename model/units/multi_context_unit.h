// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <systemc>

#include "channels/clock_domain.h"
#include "channels/timed_channel.h"
#include "config/config.h"
#include "memory/private_cache.h"
#include "stats/counters.h"
#include "stats/stall_account.h"
#include "units/context_queue.h"

namespace sheaf {

// What every unit with contexts counts about its pipeline.
#define SHEAF_PIPELINE_COUNTERS(X)                                             \
  X(num_accepted, "packets", "Packets or jobs taken in")                       \
  X(num_issues, "steps", "Steps issued, those repeated after a miss included") \
  X(num_reissues, "steps", "Steps issued again after their data had come")     \
  X(issue_slots, "cycles", "Cycles in which the issue port was taken")
SHEAF_STATS(PipelineStats, SHEAF_PIPELINE_COUNTERS);

/// The skeleton of the traversal, intersection and shader units: up to 64 contexts that take turns
/// on one issue port, so that one's memory latency is hidden behind the others' work.
///
/// A context that is ready joins a queue (of the same cycle: the lowest number first). The port
/// takes the queue's head as soon as it is free. A step that finds all its lines occupies the port
/// for its slots and is done after hit latency + unit latency; one that misses occupies it for one
/// initiation interval, waits until all its lines have come and is issued again, without another
/// look-up of the lines it had.
///
/// A unit runs ahead of all others up to the earliest cycle at which an input can reach it
/// (earliest_input), which it knows from what it has asked for and from when those it has asked act
/// next. All it writes carries its own time.
///
/// Derived provides: accept_inputs(now); ready(context, now), called when a context's time has
/// come, which does what is due and tells whether the context wants the issue port; issue(context,
/// now); and earliest_input(). It calls the protected members below.
template <typename Derived>
class MultiContextUnit : public sc_core::sc_module, public Agent {
 public:
  Cycles wake(Cycles now) final {
    // What arrives behind the unit's own time found no free context until then.
    if (now <= latest_ && !resumes_) return latest_ + 1;
    resumes_ = false;
    bound_ = now + 1;
    for (;;) {
      act(now);
      if (held_back_) {
        held_back_ = false;
        resumes_ = true;
        break;
      }
      now = next_event();
      if (now < bound_) continue;
      if (now >= domain_.end() || !is_safe(now)) break;
    }
    domain_.happened(latest_);
    return now;
  }

  [[nodiscard]] const PipelineStats& pipeline_stats() const { return pipeline_stats_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) {
    account(end);
    stalls_.finish(end);
  }
  [[nodiscard]] int num_held() const { return std::popcount(held_); }

  // As of cycle `now`, up to which everything has been done.
  [[nodiscard]] StallCause cause_at(Cycles now) const {
    return busy_until_ > now ? StallCause::kBusy : waiting_cause();
  }
  [[nodiscard]] bool port_taken_at(Cycles now) const { return port_free_ > now; }
  /// Bit i: context i is held.
  [[nodiscard]] std::uint64_t held_contexts() const { return held_; }

 protected:
  MultiContextUnit(const sc_core::sc_module_name& name, const UnitSpec& spec, int packet_size,
                   ClockDomain& domain)
      : sc_module(name),
        spec_(spec),
        domain_(domain),
        slots_per_step_((static_cast<std::uint32_t>(packet_size) + spec.lanes - 1) / spec.lanes) {
    inbox_.bind(domain, domain.add(*this));
    free_ = spec.contexts == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << spec.contexts) - 1;
  }

  /// What the issue port is taken for by a step of so many slots.
  [[nodiscard]] std::uint32_t port_cycles(std::uint32_t slots) const {
    return static_cast<std::uint32_t>(slots * spec_.initiation_interval);
  }
  [[nodiscard]] std::uint32_t step_latency() const {
    return static_cast<std::uint32_t>(spec_.latency);
  }

  // Contexts, held from take_context() until free_context().
  [[nodiscard]] bool has_free_context() const { return free_ != 0; }
  int take_context() {
    const int context = std::countr_zero(free_);
    free_ &= free_ - 1;
    held_ |= std::uint64_t{1} << context;
    ++pipeline_stats_.num_accepted;
    return context;
  }
  void free_context(int context) {
    free_ |= std::uint64_t{1} << context;
    held_ &= ~(std::uint64_t{1} << context);
  }

  /// ready(context) will be called at `time`.
  void schedule(int context, Cycles time) { agenda_.insert(context, time); }
  /// Occupies the port for a whole step and schedules the context for when it is done.
  /// `hit_latency`: of the lines it fetched, 0 if none; `port_cycles`: cycles that these accesses
  /// need of the cache port, if more than its slots.
  void occupy(int context, Cycles slots, Cycles hit_latency, Cycles port_cycles, Cycles now) {
    occupy_for(context, std::max(slots * spec_.initiation_interval, port_cycles),
               hit_latency + spec_.latency, now);
  }
  /// Occupies the port for a step that only fetches: one cycle a line, done after hit latency.
  void occupy_fetch(int context, Cycles hit_latency, Cycles port_cycles, Cycles now) {
    occupy_for(context, std::max<Cycles>(1, port_cycles), hit_latency, now);
  }
  /// Occupies the port for the attempt of a step that missed.
  void occupy_missed(Cycles port_cycles, Cycles now) {
    const Cycles taken = std::max(spec_.initiation_interval, port_cycles);
    port_free_ = now + taken;
    pipeline_stats_.issue_slots += taken;
    ++pipeline_stats_.num_issues;
    if (port_free_ > busy_until_) busy_until_ = port_free_;
  }

  /// Whether all that other units do before `now` has been simulated, so that a channel which seems
  /// full is full.
  [[nodiscard]] bool is_certain(Cycles now) const { return now <= domain_.horizon(); }
  /// Not knowing: stops here, and calls ready(context) again once it is certain.
  void hold_back(int context, Cycles now) {
    held_back_ = true;
    schedule(context, now);
  }

  /// To be called whenever the unit has written to another one or a context has become free: what
  /// follows may be felt earlier than was known, and has to be looked up again.
  void look_again() { bound_ = 0; }

  // Contexts that wait for an answer of another unit, which cannot come before `earliest`.
  void await(int context, Cycles earliest) {
    awaiting_ |= std::uint64_t{1} << context;
    awaited_[static_cast<std::size_t>(context)] = earliest;
  }
  void answered(int context) { awaiting_ &= ~(std::uint64_t{1} << context); }
  [[nodiscard]] std::uint64_t awaiting() const { return awaiting_; }
  /// The least of `input` and of the earliest answer that one of these contexts, or line that one
  /// of these parked ones, can get over links of this lookahead.
  [[nodiscard]] Cycles or_answer(Cycles input, std::uint64_t contexts,
                                 const Lookahead& links) const {
    if (contexts == 0) return input;
    const Cycles over_links = links.earliest();
    if (over_links >= input) return input;
    Cycles awaited = kNever;
    for (std::uint64_t left = contexts; left != 0; left &= left - 1) {
      awaited = std::min(awaited, awaited_[static_cast<std::size_t>(std::countr_zero(left))]);
    }
    return std::min(input, std::max(awaited, over_links));
  }

  // Contexts that a full channel holds up.
  void block(int context) {
    blocked_ |= std::uint64_t{1} << context;
    look_again();
  }
  void unblock(int context) { blocked_ &= ~(std::uint64_t{1} << context); }

  // Contexts whose step waits for lines.
  void park(int context, Cycles earliest_line) {
    if (earliest_line < bound_) bound_ = earliest_line;
    parked_ |= std::uint64_t{1} << context;
    awaited_[static_cast<std::size_t>(context)] = earliest_line;
  }
  void unpark(int context, Cycles now) {
    parked_ &= ~(std::uint64_t{1} << context);
    ++pipeline_stats_.num_reissues;
    schedule(context, now);
  }

  const UnitSpec spec_;
  ClockDomain& domain_;
  Inbox inbox_;
  const std::uint32_t slots_per_step_;

 private:
  // Looks up the bound as far as is needed to tell whether `next` is below it.
  [[nodiscard]] bool is_safe(Cycles next) {
    bound_ = std::min(domain_.horizon(), domain_.end());
    if (next < bound_) return true;
    // A blocked context may be let go at any time.
    if (blocked_ != 0 || domain_.in_step()) return false;
    const Cycles input = static_cast<Derived&>(*this).earliest_input();
    bound_ = std::max(bound_, std::min({input, domain_.limit(), domain_.end()}));
    return next < bound_;
  }
  [[nodiscard]] Cycles next_event() const {
    const Cycles next = std::min(agenda_.next(), inbox_.next());
    return ready_.is_empty() ? next : std::min(next, port_free_);
  }

  // All that is due at `now`: inputs first, then contexts, then the issue port.
  void act(Cycles now) {
    latest_ = now;
    account(now);
    auto& self = static_cast<Derived&>(*this);
    if (inbox_.next() <= now) inbox_.set_next(self.accept_inputs(now));
    for (std::uint64_t left = blocked_; left != 0; left &= left - 1) {
      go_on(std::countr_zero(left), now);
    }
    while (agenda_.next() == now) {
      go_on(agenda_.pop(), now);
      if (held_back_) return;  // the rest of this cycle waits with it
    }
    if (!ready_.is_empty() && port_free_ <= now) self.issue(ready_.pop(), now);
  }

  // A context that wants the port gets it at once, ahead of time, if nothing can happen until it
  // is free: it is next in the queue, and what other contexts do meanwhile changes nothing for it.
  void go_on(int context, Cycles now) {
    auto& self = static_cast<Derived&>(*this);
    if (!self.ready(context, now)) return;
    const Cycles start = std::max(now, port_free_);
    if (ready_.is_empty() && start < std::min(bound_, inbox_.next())) {
      self.issue(context, start);
    } else {
      ready_.push(context);
    }
  }

  void occupy_for(int context, Cycles taken, Cycles latency, Cycles now) {
    port_free_ = now + taken;
    pipeline_stats_.issue_slots += taken;
    ++pipeline_stats_.num_issues;
    const Cycles done = port_free_ - 1 + latency;
    if (done > busy_until_) busy_until_ = done;
    schedule(context, done);
  }

  /// Accounts for the time since the last event if the pipeline has run empty in between: nothing
  /// else can have changed. While it is busy there is nothing to do.
  void account(Cycles now) {
    if (busy_until_ >= now) return;
    stalls_.switch_to(waiting_cause(), busy_until_);
    stalls_.switch_to(StallCause::kBusy, now);
    busy_until_ = now;
  }
  [[nodiscard]] StallCause waiting_cause() const {
    if (blocked_ != 0) return StallCause::kBlockedOutput;
    if (parked_ != 0) return StallCause::kWaitingMemory;
    return held_ != 0 ? StallCause::kWaitingInput : StallCause::kIdle;
  }

  ContextAgenda agenda_;
  ReadyQueue ready_;
  std::uint64_t free_ = 0;
  std::uint64_t held_ = 0;
  std::uint64_t blocked_ = 0;
  std::uint64_t parked_ = 0;
  std::uint64_t awaiting_ = 0;
  std::array<Cycles, 64> awaited_{};  ///< of contexts in awaiting_ or parked_
  bool held_back_ = false;
  bool resumes_ = false;  ///< goes on with the cycle in which it was held back
  Cycles latest_ = 0;     ///< everything up to this cycle has been done
  Cycles bound_ = 0;      ///< nothing can arrive before this cycle, as far as has been looked up
  Cycles port_free_ = 0;
  Cycles busy_until_ = 0;
  PipelineStats pipeline_stats_;
  StallAccount stalls_;  ///< busy up to busy_until_

 protected:
  [[nodiscard]] std::uint64_t parked() const { return parked_; }
  [[nodiscard]] std::uint64_t blocked() const { return blocked_; }
};

}  // namespace sheaf
