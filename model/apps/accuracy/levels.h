// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "stats/sample_estimate.h"
#include "system/prepared_scene.h"

namespace sheaf {

/// A way to simulate a frame.
struct Level {
  std::string name;
  std::vector<std::string> settings;  ///< run.*, as for --set
};

/// From cheap to dear, `timed` and `clocked` among them.
[[nodiscard]] const std::vector<Level>& levels();

/// What one level gave.
struct LevelRun {
  Level level;
  double processor_seconds = 0;  ///< median over the runs, as is the next; scene and tree excluded
  double wall_seconds = 0;
  std::vector<Estimate> quantities;  ///< as observed_quantities(); NaN: not there

  // Against a reference: relative for totals and p_t, a difference for rates.
  [[nodiscard]] double error(std::size_t quantity, const LevelRun& reference) const;
  /// Half the length of a confidence interval on the same scale; 0 where none is stated.
  [[nodiscard]] double uncertainty(std::size_t quantity, const LevelRun& reference) const;
  /// What can be relied on: the worse of error and uncertainty, in cycles and in DRAM bytes.
  [[nodiscard]] double reliable_within(const LevelRun& reference) const;
  /// Largest error of any hit rate.
  [[nodiscard]] double worst_hit_rate_error(const LevelRun& reference) const;
};

/// Whether an error of this quantity is a difference, not relative: for rates, which may be 0.
[[nodiscard]] bool is_rate(std::size_t quantity);

/// Simulates the scene at a level in a process of its own, several times if it takes little time.
/// None if `stop` ended it. Throws Error for a machine that is stuck, and for one that
/// run.max_cycles ends.
[[nodiscard]] std::optional<LevelRun> run_level(const Level& level, const Config& config,
                                                const PreparedScene& scene,
                                                const std::function<bool()>& stop);

/// Those that no other beats in both processor time and reliable_within().
[[nodiscard]] std::vector<bool> pareto_front(const std::vector<LevelRun>& runs,
                                             const LevelRun& reference);

/// The run that takes least processor time of those within `limit`; null if there is none.
[[nodiscard]] const LevelRun* cheapest_within(double limit, const std::vector<LevelRun>& runs,
                                              const LevelRun& reference);

}  // namespace sheaf
