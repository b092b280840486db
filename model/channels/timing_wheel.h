// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/units.h"

namespace sheaf {

/// A calendar of at most 64 agents, each with at most one pending time. The next kSlots
/// cycles have a slot each, a bit set of agents; later times wait in a list that is looked at when
/// the near slots have run out. Scheduling and taking out cost a few nanoseconds.
///
/// Agents due in the same cycle come out in ascending order.
class TimingWheel {
 public:
  static constexpr std::size_t kSlots = 256;
  static constexpr std::size_t kMaxAgents = 64;

  TimingWheel() { due_.fill(kNever); }

  /// Makes `agent` due at `time`, or leaves it if it is due earlier already. Times before the
  /// cycle that was last taken out are a programming error.
  void schedule(std::size_t agent, Cycles time) {
    if (time >= due_[agent]) return;
    if (due_[agent] != kNever) remove(agent);
    due_[agent] = time;
    insert(agent, time);
  }

  /// Takes an agent out of the calendar, due or not.
  void cancel(std::size_t agent) {
    if (due_[agent] == kNever) return;
    remove(agent);
    due_[agent] = kNever;
  }

  /// The earliest pending time, or kNever.
  [[nodiscard]] Cycles peek() {
    const Cycles near = first_near();
    if (near < far_min_) return near;
    if (far_min_ == kNever) return kNever;
    // Only far times are left, or a far one has come within reach: bring them near.
    const Cycles base = far_min_ < near ? far_min_ : near;
    base_ = base;
    bring_near();
    return first_near();
  }

  /// Removes and returns the lowest agent due at `time`, which must be what peek() returned.
  std::size_t pop(Cycles time) {
    base_ = time;
    std::uint64_t& slot = slots_[time % kSlots];
    const auto agent = static_cast<std::size_t>(std::countr_zero(slot));
    slot &= slot - 1;
    due_[agent] = kNever;
    if (slot == 0) clear_occupied(time % kSlots);
    return agent;
  }

  [[nodiscard]] Cycles due(std::size_t agent) const { return due_[agent]; }

 private:
  void insert(std::size_t agent, Cycles time) {
    if (time - base_ < kSlots) {
      slots_[time % kSlots] |= std::uint64_t{1} << agent;
      occupied_[time % kSlots / 64] |= std::uint64_t{1} << (time % 64);
    } else {
      far_.push_back(agent);
      if (time < far_min_) far_min_ = time;
    }
  }

  void remove(std::size_t agent) {
    const Cycles time = due_[agent];
    std::uint64_t& slot = slots_[time % kSlots];
    const std::uint64_t bit = std::uint64_t{1} << agent;
    if (time - base_ < kSlots && (slot & bit) != 0) {
      slot &= ~bit;
      if (slot == 0) clear_occupied(time % kSlots);
      return;
    }
    std::erase(far_, agent);
    update_far_min(agent);
  }

  void update_far_min(std::size_t removed) {
    far_min_ = kNever;
    for (const std::size_t agent : far_) {
      if (agent != removed && due_[agent] < far_min_) far_min_ = due_[agent];
    }
  }

  void bring_near() {
    std::vector<std::size_t> waiting;
    waiting.swap(far_);
    far_min_ = kNever;
    for (const std::size_t agent : waiting) insert(agent, due_[agent]);
  }

  [[nodiscard]] Cycles first_near() const {
    const std::size_t start = base_ % kSlots;
    const std::size_t first_word = start / 64;
    const std::uint64_t head = occupied_[first_word] >> (start % 64);
    if (head != 0) return base_ + static_cast<Cycles>(std::countr_zero(head));
    constexpr std::size_t kOccupiedWords = kSlots / 64;
    for (std::size_t i = 1; i <= kOccupiedWords; ++i) {
      const std::uint64_t word = occupied_[(first_word + i) % kOccupiedWords];
      if (word != 0) {
        const auto offset = i * 64 - start % 64 + static_cast<std::size_t>(std::countr_zero(word));
        return base_ + offset;
      }
    }
    return kNever;
  }

  void clear_occupied(std::size_t slot) {
    occupied_[slot / 64] &= ~(std::uint64_t{1} << (slot % 64));
  }

  Cycles base_ = 0;  ///< no pending time is earlier
  Cycles far_min_ = kNever;
  std::array<std::uint64_t, kSlots / 64> occupied_{};
  std::array<std::uint64_t, kSlots> slots_{};
  std::array<Cycles, kMaxAgents> due_{};
  std::vector<std::size_t> far_;
};

}  // namespace sheaf
