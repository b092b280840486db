// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "base/units.h"

namespace sheaf {

/// How soon each agent's doing can be felt at one place: added to the time at which the agent acts
/// next, a lower bound on the arrival. kFarAway where it never can. One entry an agent.
using Reach = std::vector<Cycles>;

/// The links between the agents of a clock domain with their least latencies, and what follows from
/// them: an agent that acts at cycle t cannot be felt elsewhere before t + the length of the
/// shortest way. (The distance between logical processes of conservative parallel simulation:
/// B. D. Lubachevsky, "Efficient distributed event-driven simulations of multiple-loop networks",
/// CACM 32(1), 1989.)
class LinkMap {
 public:
  /// Large, and small enough to be added to a time.
  static constexpr Cycles kFarAway = Cycles{1} << 60U;

  /// Something that `from` does can make `to` act `latency` cycles later, at the earliest.
  void add(std::size_t from, std::size_t to, Cycles latency);

  /// Of anything that reaches `to` over a link from one of `last`. An agent of which no link is
  /// known is taken to reach every other one within a cycle.
  [[nodiscard]] Reach reach(const std::vector<std::size_t>& last, std::size_t to,
                            std::size_t num_agents) const;

 private:
  struct Link {
    std::size_t from = 0;
    std::size_t to = 0;
    Cycles latency = 0;
    bool assumed = false;
  };
  [[nodiscard]] std::vector<Link> complete(std::size_t num_agents) const;

  std::vector<Link> links_;
};

}  // namespace sheaf
