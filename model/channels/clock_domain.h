// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <exception>
#include <functional>
#include <string>
#include <systemc>
#include <vector>

#include "base/units.h"
#include "channels/calendar.h"
#include "channels/cycle_observer.h"
#include "channels/lookahead.h"

namespace sheaf {

/// Something that acts in time within a clock domain: a unit, a cache level, a memory.
class Agent {
 public:
  virtual ~Agent() = default;

  /// Does everything due at cycle `now`, and may go on to later cycles as long as they stay below
  /// the domain's horizon(). Returns the next cycle at which it has something to do of its own
  /// accord, or kNever.
  virtual Cycles wake(Cycles now) = 0;

  /// One line on what holds this agent up, empty if nothing does; for the message about a machine
  /// that cannot go on.
  [[nodiscard]] virtual std::string stuck_reason() const { return {}; }
};

/// All agents of one clock, ordered in time by one calendar that is driven by one SystemC process.
///
/// Units meet only through channels whose latency is at least one cycle, so agents due in the same
/// cycle do not see each other's doing and their order is that of their registration. An agent may
/// run ahead of the calendar to just below the next time at which any other agent is due, and
/// further to just below the earliest time at which anything can reach it, which changes no result;
/// a quantum lets it go further still, which does. The SystemC kernel is entered when another
/// SystemC process has something to do, not once for every hand-over.
class ClockDomain : public sc_core::sc_module {
 public:
  /// `period`: one clock cycle.
  ClockDomain(const sc_core::sc_module_name& name, const sc_core::sc_time& period);

  /// Registers an agent; its index is its rank among those due in the same cycle.
  std::size_t add(Agent& agent);

  /// Wakes `agent` at `time` or earlier.
  void schedule(std::size_t agent, Cycles time) { calendar_.schedule(agent, time); }

  /// The running agent may act on its own at any cycle below this one.
  [[nodiscard]] Cycles horizon() const {
    return std::min(calendar_.first_due() + quantum_, limit_);
  }

  /// Lets every agent run so many cycles further ahead than is exact. What reaches an agent late is
  /// taken at its own time; nothing is lost. To be called before the simulation starts.
  void set_quantum(Cycles quantum) { quantum_ = quantum; }
  [[nodiscard]] Cycles quantum() const { return quantum_; }

  /// Something that agent `from` does can make `to` act `latency` cycles later, at the earliest. An
  /// agent that declares nothing is taken to be a cycle away from every other.
  void declare_link(std::size_t from, std::size_t to, Cycles latency) {
    links_.add(from, to, latency);
  }
  /// Once all links have been declared: see LinkMap::reach.
  [[nodiscard]] Reach reach(const std::vector<std::size_t>& last, std::size_t to) const {
    return links_.reach(last, to, agents_.size());
  }

  /// Makes every agent act in the calendar's order, cycle by cycle: slower, with the same result.
  /// For tests of just that.
  void forbid_running_ahead() { in_step_ = true; }
  [[nodiscard]] bool in_step() const { return in_step_; }

  /// Adds an observer; to be called before the simulation starts.
  void observe(CycleObserver& observer);

  /// An agent did something at this cycle, which may lie ahead of the calendar.
  void happened(Cycles when) { latest_ = std::max(latest_, when); }
  /// The last cycle in which any agent did something.
  [[nodiscard]] Cycles latest() const { return latest_; }

  [[nodiscard]] const Calendar& calendar() const { return calendar_; }
  /// The cycle at which another SystemC process may act; no agent may go further.
  [[nodiscard]] Cycles limit() const { return limit_; }

  /// The last cycle, exclusive, that the run may reach.
  [[nodiscard]] Cycles end() const { return end_; }

  [[nodiscard]] const sc_core::sc_time& period() const { return period_; }
  /// The local time offset to pass along a TLM call made at cycle `now`.
  /// Throws Error(kUsage) beyond what SystemC's 64 bits can say.
  [[nodiscard]] sc_core::sc_time offset(Cycles now) const { return span(kernel_cycle_, now); }
  /// What passes from one cycle to another that is no earlier; throws alike.
  [[nodiscard]] sc_core::sc_time span(Cycles from, Cycles to) const {
    if (to > last_cycle_) refuse_time(to);
    return sc_core::sc_time::from_value((to - from) * period_.value());
  }
  /// The inverse: the cycle that lies `offset` after the time at which this domain was entered,
  /// rounded up.
  [[nodiscard]] Cycles cycle_at(const sc_core::sc_time& offset) const;
  /// The same for a caller outside the domain: the cycle that lies `offset` after the kernel's
  /// time.
  [[nodiscard]] Cycles cycle_at_kernel_offset(const sc_core::sc_time& offset) const;

  /// Called by whoever notified a SystemC event from within an agent: the kernel has to be asked
  /// again how far the domain may go.
  void kernel_touched() { limit_ = 0; }

  /// Runs the simulation until it ends. What is thrown within it is thrown here: SystemC itself
  /// would make a message of its own of an exception that leaves a process.
  void run();

  /// Ends the simulation after the current agent returns.
  void stop() { stopped_ = true; }
  void set_end(Cycles end) { end_ = end; }
  /// Called every few thousand wake-ups with the current cycle; returns true to stop.
  void set_monitor(std::function<bool(Cycles)> monitor) { monitor_ = std::move(monitor); }

  /// The cycle of the last wake-up.
  [[nodiscard]] Cycles now() const { return now_; }
  [[nodiscard]] bool stopped() const { return stopped_; }
  /// True if the calendar ran empty without stop() having been called.
  [[nodiscard]] bool ran_dry() const { return ran_dry_; }
  [[nodiscard]] std::uint64_t num_wakes() const { return num_wakes_; }

 private:
  [[noreturn]] void refuse_time(Cycles now) const;
  void advance();
  void run_until(Cycles limit);
  void show(Cycles cycle);
  void find_next_observed(Cycles from);
  void finish();
  [[nodiscard]] Cycles next_foreign_cycle() const;

  const sc_core::sc_time period_;
  const Cycles last_cycle_;  ///< that SystemC's time can reach and be rounded up to
  Calendar calendar_;
  LinkMap links_;
  std::vector<Agent*> agents_;
  std::vector<CycleObserver*> observers_;
  Cycles observed_ = kNever;  ///< the next cycle to be observed
  bool kernel_follows_ = false;
  std::function<bool(Cycles)> monitor_;
  Cycles now_ = 0;
  Cycles latest_ = 0;
  Cycles kernel_cycle_ = 0;  ///< sc_time_stamp() in cycles
  Cycles limit_ = 0;
  Cycles quantum_ = 0;
  Cycles end_ = kNever;
  std::uint64_t num_wakes_ = 0;
  std::exception_ptr error_;  ///< thrown within the simulation
  bool stopped_ = false;
  bool ran_dry_ = false;
  bool finished_ = false;
  bool in_step_ = false;
};

/// The earliest time at which something can come over the links from some agents, for an agent that
/// is acting at the moment; later by the domain's quantum.
class Lookahead {
 public:
  /// Once all links have been declared; `last`: the agents at the other end of these links.
  void bind(const ClockDomain& domain, const std::vector<std::size_t>& last, std::size_t agent);
  /// Whether earliest() is later than `time`.
  [[nodiscard]] bool is_beyond(Cycles time) const {
    return calendar_->first_due() + nearest_ > time || earliest() > time;
  }
  [[nodiscard]] Cycles earliest() const {
    Cycles earliest = calendar_->first_due() + others_;
    for (const Neighbour& neighbour : neighbours_) {
      earliest = std::min(earliest, calendar_->due(neighbour.agent) + neighbour.distance);
    }
    return earliest;
  }

 private:
  struct Neighbour {
    std::size_t agent = 0;
    Cycles distance = 0;
  };
  const Calendar* calendar_ = nullptr;
  std::vector<Neighbour> neighbours_;  ///< the nearest, each by itself
  Cycles others_ = 0;                  ///< distance of the nearest of the others
  Cycles nearest_ = 0;                 ///< distance of the nearest of all
};

/// Where a channel reports to: an agent, its domain, and the earliest time at which one of the
/// agent's input channels has something for it.
class Inbox {
 public:
  /// `lag`: cycles that the agent can let an arrival lie, since nothing that it does about it is
  /// felt elsewhere earlier than if it had acted that much later.
  void bind(ClockDomain& domain, std::size_t agent, Cycles lag = 0) {
    domain_ = &domain;
    agent_ = agent;
    lag_ = lag;
  }
  void expect(Cycles arrival) {
    if (arrival < next_) next_ = arrival;
    domain_->schedule(agent_, arrival + lag_);
  }
  [[nodiscard]] ClockDomain& domain() const { return *domain_; }
  [[nodiscard]] std::size_t agent() const { return agent_; }
  /// Wakes the agent without any input being there (a slot became free, a count changed).
  void nudge(Cycles time) { domain_->schedule(agent_, time); }
  [[nodiscard]] Cycles next() const { return next_; }
  void set_next(Cycles next) { next_ = next; }

 private:
  ClockDomain* domain_ = nullptr;
  std::size_t agent_ = 0;
  Cycles lag_ = 0;
  Cycles next_ = kNever;
};

}  // namespace sheaf
