// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/watch_window.h"

#include <gtest/gtest.h>

namespace sheaf {
namespace {

TEST(WatchWindow, ReadsCyclesWithOrWithoutEnds) {
  EXPECT_EQ(WatchWindow::parse("10..20")->begin, 10U);
  EXPECT_EQ(WatchWindow::parse("10..20")->end, 20U);
  EXPECT_EQ(WatchWindow::parse("10..")->end, kNever);
  EXPECT_EQ(WatchWindow::parse("..20")->begin, 0U);
}

TEST(WatchWindow, RefusesWhatIsNoWindow) {
  for (const char* wrong : {"", "10", "10.20", "20..10", "10..10", "a..20", "10..2x", "-1..5",
                            "1..2..3", "10 ..20", "..0"}) {
    EXPECT_FALSE(WatchWindow::parse(wrong)) << wrong;
  }
}

TEST(WatchWindow, HoldsItsFirstCycleAndNotItsEnd) {
  const WatchWindow window{.begin = 10, .end = 20};
  EXPECT_FALSE(window.holds(9));
  EXPECT_TRUE(window.holds(10));
  EXPECT_TRUE(window.holds(19));
  EXPECT_FALSE(window.holds(20));
  EXPECT_EQ(window.next(0), 10U);
  EXPECT_EQ(window.next(20), kNever);
}

TEST(WatchWindow, TakesTheFirstStretchOfEverySo) {
  const Cycles stretch = WatchWindow::kStretch;
  const WatchWindow window{.begin = 100, .end = 100 + 7 * stretch, .every = 3};
  EXPECT_TRUE(window.holds(100 + stretch - 1));
  EXPECT_FALSE(window.holds(100 + stretch));
  EXPECT_EQ(window.next(100 + stretch), 100 + 3 * stretch);
  EXPECT_EQ(window.next(100 + 6 * stretch + 5), 100 + 6 * stretch + 5);
  EXPECT_EQ(window.next(100 + 7 * stretch), kNever);
}

}  // namespace
}  // namespace sheaf
