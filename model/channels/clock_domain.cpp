// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "channels/clock_domain.h"

#include <fmt/format.h>

#include <limits>

#include "base/errors.h"

namespace sheaf {
namespace {

// How often the monitor is asked whether to go on: often enough to answer Ctrl-C at once, seldom
// enough not to be felt.
constexpr std::uint64_t kMonitorInterval = 1U << 14;

}  // namespace

void Lookahead::bind(const ClockDomain& domain, const std::vector<std::size_t>& last,
                     std::size_t agent) {
  calendar_ = &domain.calendar();
  Reach reach = domain.reach(last, agent);
  for (Cycles& distance : reach) distance += domain.quantum();
  others_ = LinkMap::kFarAway;
  nearest_ = *std::min_element(reach.begin(), reach.end());
  for (std::size_t from = 0; from < reach.size(); ++from) {
    if (from == agent) continue;
    if (std::find(last.begin(), last.end(), from) != last.end()) {
      neighbours_.push_back({from, reach[from]});
    } else {
      others_ = std::min(others_, reach[from]);
    }
  }
}

ClockDomain::ClockDomain(const sc_core::sc_module_name& name, const sc_core::sc_time& period)
    : sc_module(name),
      period_(period),
      last_cycle_(std::numeric_limits<sc_dt::uint64>::max() / period.value() - 1) {
  SC_HAS_PROCESS(ClockDomain);
  SC_METHOD(advance);
}

void ClockDomain::refuse_time(Cycles now) const {
  throw Error(ExitCode::kUsage,
              fmt::format("clock.frequency = {:.3g} Hz: cycle {} lies beyond the {:.3g} s that "
                          "simulated time can reach; choose a faster clock",
                          1.0 / period_.to_seconds(), now,
                          static_cast<double>(last_cycle_) * period_.to_seconds()));
}

std::size_t ClockDomain::add(Agent& agent) {
  agents_.push_back(&agent);
  return calendar_.add();
}

Cycles ClockDomain::cycle_at(const sc_core::sc_time& offset) const {
  return kernel_cycle_ + (offset.value() + period_.value() - 1) / period_.value();
}

Cycles ClockDomain::cycle_at_kernel_offset(const sc_core::sc_time& offset) const {
  const auto at = sc_core::sc_time_stamp().value() + offset.value();
  return (at + period_.value() - 1) / period_.value();
}

Cycles ClockDomain::next_foreign_cycle() const {
  if (!sc_core::sc_pending_activity_at_future_time()) return kNever;
  return cycle_at(sc_core::sc_time_to_pending_activity());
}

void ClockDomain::run_until(Cycles limit) {
  limit_ = limit;
  for (;;) {
    const Cycles next = calendar_.next();
    if (next >= limit_ || next >= end_) return;
    now_ = next;
    const std::size_t agent = calendar_.pop();
    calendar_.schedule(agent, agents_[agent]->wake(next));
    if (stopped_) return;
    if (++num_wakes_ % kMonitorInterval == 0 && monitor_ && monitor_(now_)) {
      stopped_ = true;
      return;
    }
  }
}

void ClockDomain::run() {
  sc_core::sc_start();
  if (error_) std::rethrow_exception(error_);
}

void ClockDomain::advance() try {
  kernel_cycle_ = sc_core::sc_time_stamp().value() / period_.value();
  if (finished_) {
    sc_core::sc_stop();
    return;
  }
  if (sc_core::sc_pending_activity_at_current_time()) {
    next_trigger(sc_core::SC_ZERO_TIME);  // whatever else happens now comes first
    return;
  }
  for (;;) {
    const Cycles foreign = next_foreign_cycle();
    const bool kernel_is_late = kernel_follows_ && kernel_cycle_ < observed_;
    const Cycles look_at = kernel_is_late || observed_ == kNever ? observed_ : observed_ + 1;
    const Cycles limit = std::min({foreign, end_, look_at});
    run_until(limit);
    if (stopped_) return finish();
    if (limit_ == 0) continue;  // the kernel was touched: ask it again how far to go
    const Cycles next = calendar_.next();
    // A run ends with the last thing that happens; what would come behind it is not shown.
    if (limit == look_at && (next != kNever || observed_ <= latest_)) {
      if (kernel_is_late) {
        next_trigger(offset(observed_));
        return;
      }
      show(observed_);
      continue;
    }
    if (next == kNever && foreign == kNever) {
      ran_dry_ = true;
      return finish();
    }
    if (next >= end_ && foreign >= end_) return finish();
    // Another SystemC process is due no later than the next agent: let it act first.
    next_trigger(offset(foreign));
    return;
  }
} catch (...) {
  error_ = std::current_exception();
  sc_core::sc_stop();
}

void ClockDomain::observe(CycleObserver& observer) {
  observers_.push_back(&observer);
  kernel_follows_ = kernel_follows_ || observer.wants_kernel_time();
  find_next_observed(0);
}

void ClockDomain::find_next_observed(Cycles from) {
  observed_ = kNever;
  for (CycleObserver* observer : observers_) {
    observed_ = std::min(observed_, observer->next_observed(from));
  }
}

void ClockDomain::show(Cycles cycle) {
  for (CycleObserver* observer : observers_) {
    if (observer->next_observed(cycle) == cycle) observer->observe(cycle);
  }
  find_next_observed(cycle + 1);
}

// The kernel's time has stayed behind; simulated time ends with the last thing that happened.
void ClockDomain::finish() {
  finished_ = true;
  next_trigger(offset(now_ > kernel_cycle_ ? now_ : kernel_cycle_));
}

}  // namespace sheaf
