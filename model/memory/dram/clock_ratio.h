// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numeric>

#include "base/units.h"

namespace sheaf {

/// Converts cycles of one clock into cycles of another one that ticks beside it, both from time 0
/// on. Exact: whole hertz, 128 bits, rounded once and up, so that no error grows with time.
class ClockRatio {
 public:
  ClockRatio(std::uint64_t from_hz, std::uint64_t to_hz) {
    const std::uint64_t common = std::gcd(from_hz, to_hz);
    multiplier_ = to_hz / common;
    divisor_ = from_hz / common;
  }
  static std::uint64_t whole_hertz(double frequency) {
    return static_cast<std::uint64_t>(std::llround(frequency));
  }

  /// The first cycle of the other clock that begins no earlier than cycle `from` of this one.
  [[nodiscard]] Cycles up(Cycles from) const {
    if (from == kNever) return kNever;
    __extension__ using Wide = unsigned __int128;
    const Wide scaled = Wide{from} * multiplier_ + (divisor_ - 1);
    return static_cast<Cycles>(scaled / divisor_);
  }

 private:
  std::uint64_t multiplier_ = 1, divisor_ = 1;
};

}  // namespace sheaf
