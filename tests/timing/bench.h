// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "channels/clock_domain.h"
#include "channels/timed_channel.h"

namespace sheaf::test {

/// An agent that does what a test wrote down for each cycle, and remembers when it was woken.
class Actor : public Agent {
 public:
  explicit Actor(ClockDomain& domain) : domain_(domain), agent_(domain.add(*this)) {
    inbox_.bind(domain, agent_);
  }
  /// Does `action` at cycle `time`.
  void at(Cycles time, std::function<void()> action) {
    actions_.emplace(time, std::move(action));
    domain_.schedule(agent_, time);
  }
  /// Called at every wake-up, with the cycle.
  void always(std::function<void(Cycles)> action) { always_ = std::move(action); }

  Cycles wake(Cycles now) override {
    wakes.push_back(now);
    if (always_) always_(now);
    while (!actions_.empty() && actions_.begin()->first <= now) {
      const auto action = actions_.begin()->second;
      actions_.erase(actions_.begin());
      action();
    }
    return actions_.empty() ? kNever : actions_.begin()->first;
  }

  Inbox& inbox() { return inbox_; }
  std::vector<Cycles> wakes;

 private:
  ClockDomain& domain_;
  std::size_t agent_;
  Inbox inbox_;
  std::multimap<Cycles, std::function<void()>> actions_;
  std::function<void(Cycles)> always_;
};

inline sc_core::sc_time one_nanosecond() {
  return {1.0, sc_core::SC_NS};
}

}  // namespace sheaf::test
