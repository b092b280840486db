// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <numeric>

#include "base/units.h"
#include "stats/counters.h"

namespace sheaf {

/// What a unit does in a cycle, exactly one of these.
enum class StallCause : std::uint8_t {
  kBusy,
  kWaitingInput,
  kWaitingMemory,
  kBlockedOutput,
  kIdle
};
inline constexpr std::size_t kNumStallCauses = 5;

inline constexpr std::array<CounterInfo, kNumStallCauses> kStallInfos{{
    {"stall_cycles_busy", "cycles", "Cycles in which the unit did work"},
    {"stall_cycles_waiting_input", "cycles",
     "Cycles in which everything it held waited for another unit's answer"},
    {"stall_cycles_waiting_memory", "cycles", "Cycles in which all its work waited for memory"},
    {"stall_cycles_blocked_output", "cycles", "Cycles in which a full link held its results back"},
    {"stall_cycles_idle", "cycles", "Cycles in which it held nothing"},
}};

[[nodiscard]] constexpr std::string_view to_string(StallCause cause) {
  switch (cause) {
    case StallCause::kBusy:
      return "busy";
    case StallCause::kWaitingInput:
      return "waits for another unit";
    case StallCause::kWaitingMemory:
      return "waits for memory";
    case StallCause::kBlockedOutput:
      return "blocked by a full link";
    case StallCause::kIdle:
      return "idle";
  }
  return "";
}

/// Attributes every cycle of one unit to one cause, so that the causes sum to the length of the run
/// exactly. The unit says when it changes what it does; nothing is done per cycle.
class StallAccount {
 public:
  /// From cycle `now` on the unit does `cause`; `now` never goes back. Switching several times in a
  /// cycle is allowed: the last switch gets the cycle.
  void switch_to(StallCause cause, Cycles now) noexcept {
    close(now);
    cause_ = cause;
  }

  /// Ends the account with a run of `end` cycles. A unit that never switched was idle throughout.
  void finish(Cycles end) noexcept { close(end); }

  [[nodiscard]] StallCause cause() const noexcept { return cause_; }
  [[nodiscard]] Cycles cycles(StallCause cause) const noexcept {
    return cycles_[static_cast<std::size_t>(cause)];
  }
  /// The time of the last switch or of finish().
  [[nodiscard]] Cycles total() const noexcept {
    return std::accumulate(cycles_.begin(), cycles_.end(), Cycles{0});
  }

  /// Whether time has never gone back, without which no cause's cycles can be believed.
  [[nodiscard]] bool is_ordered() const noexcept { return is_ordered_; }

  /// For StatsTree::add_counters.
  template <typename F>
  void for_each(F&& f) const {
    for (std::size_t i = 0; i < kNumStallCauses; ++i) f(kStallInfos[i], cycles_[i]);
  }

 private:
  void close(Cycles now) noexcept {
    is_ordered_ = is_ordered_ && now >= since_;
    cycles_[static_cast<std::size_t>(cause_)] += now - since_;
    since_ = now;
  }

  std::array<Cycles, kNumStallCauses> cycles_{};
  Cycles since_ = 0;
  StallCause cause_ = StallCause::kIdle;
  bool is_ordered_ = true;
};

}  // namespace sheaf
