// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "channels/clock_domain.h"

namespace sheaf {

/// An agent that does one thing after another, each at a cycle of its own, as far ahead as its
/// domain's horizon lets it. With a quantum, something may reach it that should have come before
/// what it has done already: it is taken at the agent's next cycle.
class SteppingAgent : public Agent {
 public:
  explicit SteppingAgent(ClockDomain& domain) : domain_(domain) {}

  Cycles wake(Cycles now) final {
    for (;;) {
      now = std::max(now, own_time_);
      own_time_ = now + 1;
      domain_.happened(now);
      const Cycles next = act(now);
      if (next >= domain_.horizon()) return next;
      now = next;
    }
  }

 private:
  /// Does everything due at cycle `now`, which is later than that of any call before. Returns the
  /// next cycle at which there is something to do, or kNever.
  virtual Cycles act(Cycles now) = 0;

  ClockDomain& domain_;
  Cycles own_time_ = 0;  ///< everything before this cycle has been done
};

}  // namespace sheaf
