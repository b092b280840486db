// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/step_window.h"

#include <gtest/gtest.h>

namespace sheaf {
namespace {

TEST(StepWindow, SlidesAwayFromStepsThatWereLeft) {
  StepWindow window(4, 16);
  for (std::uint64_t record = 0; record != 100; ++record) window.at(record).left = true;
  EXPECT_TRUE(window.is_past(95));
  EXPECT_FALSE(window.is_past(96));
}

TEST(StepWindow, ForgetsNothingOfWhatItStillHolds) {
  StepWindow window(4, 16);
  for (std::uint64_t record = 0; record != 100; ++record) {
    window.at(record).done = 1000 + record;
    window.at(record).left = true;
  }
  EXPECT_EQ(window.at(96).done, 1096U);
  EXPECT_EQ(window.at(100).done, kNever);
}

TEST(StepWindow, KeepsAStepThatIsStillToBeDone) {
  StepWindow window(4, 16);
  window.at(2).context = 7;
  for (std::uint64_t record = 0; record != 16; ++record) window.at(record).left = record != 2;
  ASSERT_FALSE(window.is_past(2));
  EXPECT_EQ(window.at(2).context, 7);
  EXPECT_TRUE(window.at(15).left);
}

TEST(StepWindow, KeepsAStepThatIsWaitedFor) {
  StepWindow window(4, 16);
  auto* const waiter = reinterpret_cast<ReplayChain*>(&window);
  window.at(0).waiters = waiter;
  for (std::uint64_t record = 0; record != 16; ++record) window.at(record).left = true;
  ASSERT_FALSE(window.is_past(0));
  EXPECT_EQ(window.at(0).waiters, waiter);
}

TEST(StepWindow, RefusesToHoldMoreThanItMay) {
  StepWindow window(4, 16);
  EXPECT_NO_THROW(std::ignore = window.at(15));
  EXPECT_THROW(std::ignore = window.at(16), Error);
}

}  // namespace
}  // namespace sheaf
