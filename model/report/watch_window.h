// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/units.h"

namespace sheaf {

/// Which cycles are recorded: those from `begin` to before `end`, of them one stretch in `every`,
/// until there are `max_events`.
struct WatchWindow {
  Cycles begin = 0;
  Cycles end = kNever;
  std::uint64_t every = 1;
  std::uint64_t max_events = 1'000'000;

  /// Long enough to follow a packet on its way.
  static constexpr Cycles kStretch = 4096;

  /// The first such cycle from `cycle` on, or kNever.
  [[nodiscard]] Cycles next(Cycles cycle) const {
    cycle = std::max(cycle, begin);
    const Cycles into = (cycle - begin) % (kStretch * every);
    if (into >= kStretch) cycle += kStretch * every - into;
    return cycle < end ? cycle : kNever;
  }
  [[nodiscard]] bool holds(Cycles cycle) const { return next(cycle) == cycle; }

  /// begin and end from "A..B", "A.." or "..B"; none if it is not of that form or empty.
  [[nodiscard]] static std::optional<WatchWindow> parse(std::string_view text);
};

}  // namespace sheaf
