// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/estimate_report.h"

#include <cmath>
#include <limits>
#include <optional>

#include "system/reported_values.h"

namespace sheaf {

void report_estimate(const CounterInfo& quantity, const Estimate& estimate, StatsTree& stats) {
  const std::string path = "estimate." + std::string(quantity.name);
  const auto add = [&](const CounterInfo& info, std::optional<double> value) {
    const std::string meaning = std::string(quantity.meaning) + ": " + std::string(info.meaning);
    stats.add_real(path + '.' + std::string(info.name), value, quantity.unit, meaning);
  };
  const bool is_none = std::isnan(estimate.value);
  add(EstimateValues::value, is_none ? std::nullopt : std::optional(estimate.value));
  if (std::isnan(estimate.low)) return;
  add(EstimateValues::ci95_low, estimate.low);
  add(EstimateValues::ci95_high, estimate.high);
}

void report_frame_length(const Estimate& cycles, double frequency, StatsTree& stats) {
  const double seconds = cycles.value / frequency;
  stats.add("system", SystemValues::cycles, static_cast<std::uint64_t>(std::llround(cycles.value)));
  if (!std::isnan(cycles.low)) {
    stats.add_real("system", FrameEstimateValues::cycles_ci95_low, cycles.low);
    stats.add_real("system", FrameEstimateValues::cycles_ci95_high, cycles.high);
  }
  stats.add_real("system", SystemValues::seconds, seconds);
  stats.add_ratio("system", SystemValues::frames_per_second, 1.0, seconds);
}

void report_analytic(const AnalyticModel& model, const Config& config, StatsTree& stats) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const TileWork frame = model.frame();
  for (const Quantity& quantity : observed_quantities()) {
    const auto value = static_cast<double>(frame.seen[quantity.total]);
    const double per =
        quantity.per == Observed::kNone ? 1.0 : static_cast<double>(frame.seen[quantity.per]);
    report_estimate(quantity.info, {per == 0 ? kNone : value / per, kNone, kNone}, stats);
  }
  stats.add_counters("bound", frame.bounds);
  report_frame_length({static_cast<double>(frame.seen[Observed::kCycles]), kNone, kNone},
                      config.clock.frequency, stats);
}

}  // namespace sheaf
