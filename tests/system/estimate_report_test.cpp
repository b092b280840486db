// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/estimate_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <variant>

namespace sheaf::test {
namespace {

StatsTree length_of(const Estimate& cycles) {
  StatsTree stats;
  report_frame_length(cycles, 2e9, stats);
  return stats;
}

double real(const StatsTree& stats, const std::string& path) {
  const StatsEntry* const entry = stats.find(path);
  return entry == nullptr ? std::numeric_limits<double>::quiet_NaN()
                          : std::get<double>(entry->value);
}

TEST(FrameLength, IsRoundedToTheNearestCycle) {
  EXPECT_EQ(length_of({1000.4, 990.0, 1010.0}).count("system.cycles"), 1000U);
  EXPECT_EQ(length_of({1000.5, 990.0, 1010.0}).count("system.cycles"), 1001U);
}

TEST(FrameLength, KeepsFractionsInSecondsAndInterval) {
  const StatsTree stats = length_of({1000.4, 990.25, 1010.75});
  EXPECT_DOUBLE_EQ(real(stats, "system.seconds"), 1000.4 / 2e9);
  EXPECT_DOUBLE_EQ(real(stats, "system.frames_per_second"), 2e9 / 1000.4);
  EXPECT_DOUBLE_EQ(real(stats, "system.cycles_ci95_low"), 990.25);
  EXPECT_DOUBLE_EQ(real(stats, "system.cycles_ci95_high"), 1010.75);
}

TEST(FrameLength, HasNoIntervalWhereNoneIsKnown) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(length_of({1000.0, none, none}).find("system.cycles_ci95_low"), nullptr);
}

}  // namespace
}  // namespace sheaf::test
