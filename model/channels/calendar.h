// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/units.h"

namespace sheaf {

/// When the agents of a clock domain are due, each at one time at most. Agents due in the same
/// cycle come out in ascending order.
///
/// Time and agent share a word, so that the next agent is the least of a few words: a handful of
/// compares without a branch, which for the dozen agents of a machine is less work than keeping
/// them in order.
class Calendar {
 public:
  /// Times are below this.
  static constexpr Cycles kEndOfTime = Cycles{1} << 52U;

  /// Returns the new agent's number.
  std::size_t add() {
    if (num_agents_ % kGroup == 0) {
      groups_.emplace_back().fill(kNone);
      group_first_.push_back(kNone);
    }
    return num_agents_++;
  }

  /// Makes `agent` due at `time`, or leaves it if it is due earlier already or the time is kNever.
  /// Throws Error(kUsage) where time has ended.
  void schedule(std::size_t agent, Cycles time) {
    if (time >= kEndOfTime) {
      if (time != kNever) refuse_time(time);
      return;
    }
    const Key key = time << kAgentBits | agent;
    Key& due = groups_[agent / kGroup][agent % kGroup];
    if (key >= due) return;
    due = key;
    Key& first = group_first_[agent / kGroup];
    first = std::min(first, key);
    first_ = std::min(first_, key);
  }

  /// The earliest time at which an agent is due, or kNever.
  [[nodiscard]] Cycles next() const { return first_ == kNone ? kNever : first_ >> kAgentBits; }

  /// When an agent is due; kEndOfTime or later: never.
  [[nodiscard]] Cycles due(std::size_t agent) const {
    return groups_[agent / kGroup][agent % kGroup] >> kAgentBits;
  }
  /// The same of the first agent.
  [[nodiscard]] Cycles first_due() const { return first_ >> kAgentBits; }

  /// Takes out the first agent due at next().
  std::size_t pop() {
    const std::size_t agent = first_ & kAgentMask;
    const std::size_t group = agent / kGroup;
    groups_[group][agent % kGroup] = kNone;
    group_first_[group] = first_of(groups_[group]);
    first_ = kNone;
    for (const Key key : group_first_) first_ = std::min(first_, key);
    return agent;
  }

 private:
  [[noreturn]] static void refuse_time(Cycles time);

  using Key = std::uint64_t;
  static constexpr unsigned kAgentBits = 12;
  static_assert(kEndOfTime == Cycles{1} << (64U - kAgentBits));
  static constexpr Key kAgentMask = (Key{1} << kAgentBits) - 1;
  static constexpr Key kNone = ~Key{0};
  static constexpr std::size_t kGroup = 8;
  using Group = std::array<Key, kGroup>;

  // Four chains of minima, which the processor follows side by side.
  [[nodiscard]] static Key first_of(const Group& group) {
    std::array<Key, 4> least{group[0], group[1], group[2], group[3]};
    for (std::size_t i = 4; i < kGroup; i += 4) {
      for (std::size_t chain = 0; chain < 4; ++chain) {
        least[chain] = std::min(least[chain], group[i + chain]);
      }
    }
    return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
  }

  std::size_t num_agents_ = 0;
  std::vector<Group> groups_;
  std::vector<Key> group_first_;
  Key first_ = kNone;  ///< of all agents
};

}  // namespace sheaf
