// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/clock_ratio.h"

#include <gtest/gtest.h>

namespace sheaf::test {
namespace {

TEST(ClockRatio, RoundsUpToTheNextTick) {
  const ClockRatio ratio(1'000'000'000, 1'200'000'000);
  EXPECT_EQ(ratio.up(0), 0U);
  EXPECT_EQ(ratio.up(1), 2U);
  EXPECT_EQ(ratio.up(4), 5U);
  EXPECT_EQ(ratio.up(5), 6U);
}

TEST(ClockRatio, DoesNotDriftOverAnHour) {
  const ClockRatio ratio(1'333'333'333, 800'000'000);
  const Cycles hour = 3600ULL * 1'333'333'333ULL;
  EXPECT_EQ(ratio.up(hour), 3600ULL * 800'000'000ULL);
  EXPECT_EQ(ratio.up(hour + 1), 3600ULL * 800'000'000ULL + 1);
}

TEST(ClockRatio, ThereAndBackIsNoEarlierAndLessThanATickLater) {
  const ClockRatio there(1'700'000'000, 1'200'000'000);
  const ClockRatio back(1'200'000'000, 1'700'000'000);
  for (Cycles cycle = 0; cycle < 10000; ++cycle) {
    const Cycles again = back.up(there.up(cycle));
    EXPECT_GE(again, cycle);
    EXPECT_LE(again, cycle + 2);
  }
}

TEST(ClockRatio, NeverStaysNever) {
  EXPECT_EQ(ClockRatio(3, 7).up(kNever), kNever);
}

}  // namespace
}  // namespace sheaf::test
