// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/units.h"

namespace sheaf {

class ReplayedUnit;
struct ReplayChain;

/// What has become of a step in an elastic replay.
struct StepState {
  Cycles done = kNever;            ///< when it was done
  Cycles chain_ended = kNever;     ///< when the chain that it ends was
  ReplayedUnit* unit = nullptr;    ///< which did it,
  std::uint8_t context = 0;        ///< in which context
  bool left = false;               ///< done, answered if it called, and left behind
  ReplayChain* waiters = nullptr;  ///< chains that wait for either, linked by `next_waiter`
};

/// The steps of a stream by record number, over a window that slides on as it has to: away from
/// steps that have been left behind, the last kLeast of which are remembered at least. It grows
/// instead where the oldest step is still to be done, because its chain lags far behind others.
class StepWindow {
 public:
  static constexpr std::size_t kLeast = std::size_t{1} << 18;
  static constexpr std::size_t kMost = std::size_t{1} << 22;

  explicit StepWindow(std::size_t least = kLeast, std::size_t most = kMost)
      : steps_(least), most_(most) {}

  /// The step was left behind so long ago that nothing else is known of it.
  [[nodiscard]] bool is_past(std::uint64_t record) const { return record < first_; }
  /// For a step that is not past. The reference holds until the next call. Throws
  /// Error(kTrace) if that many steps lie between it and the oldest one still to be done.
  [[nodiscard]] StepState& at(std::uint64_t record) {
    while (record - first_ >= steps_.size()) make_room();
    return steps_[record & (steps_.size() - 1)];
  }

 private:
  void make_room() {
    StepState& oldest = steps_[first_ & (steps_.size() - 1)];
    if (oldest.left && oldest.waiters == nullptr) {
      oldest = {};
      ++first_;
    } else {
      grow();
    }
  }
  void grow() {
    if (steps_.size() == most_) {
      throw Error(ExitCode::kTrace,
                  "the trace waits for a step too far from where it has come to; replay it with "
                  "--mode fixed");
    }
    std::vector<StepState> larger(2 * steps_.size());
    for (std::uint64_t record = first_; record != first_ + steps_.size(); ++record) {
      larger[record & (larger.size() - 1)] = steps_[record & (steps_.size() - 1)];
    }
    steps_ = std::move(larger);
  }

  std::vector<StepState> steps_;  ///< a power of two; those from first_ on
  std::size_t most_;
  std::uint64_t first_ = 0;
};

}  // namespace sheaf
