// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "stats/report_tree.h"

namespace sheaf {

/// A number of events; none where the run did not count them.
using Count = std::optional<double>;

[[nodiscard]] inline Count operator+(const Count& a, const Count& b) {
  return a && b ? Count(*a + *b) : Count();
}
[[nodiscard]] inline Count operator*(const Count& a, double b) {
  return a ? Count(*a * b) : Count();
}

/// Counters of a finished run.
class Counts {
 public:
  explicit Counts(const StatsTree& stats) : stats_(stats) {}

  /// One counter.
  [[nodiscard]] Count of(const std::string& path) const;
  /// A counter of all units of a kind: "traversal_unit", "node_cache.num_hits".
  [[nodiscard]] Count all(std::string_view unit, std::string_view counter) const;
  /// The same of primary and secondary packets: "packet_triangle_tests".
  [[nodiscard]] Count traced(std::string_view counter) const;
  /// A counter of a kind of ray over all depths: "shadow", "num_spawned"; 0 if there was none.
  [[nodiscard]] Count rays(std::string_view kind, std::string_view counter) const;

 private:
  const StatsTree& stats_;
};

}  // namespace sheaf
