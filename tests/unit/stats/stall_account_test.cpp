// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/stall_account.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace sheaf {
namespace {

TEST(StallAccount, AUnitThatNeverSwitchesIsIdle) {
  StallAccount account;
  account.finish(1000);
  EXPECT_EQ(account.cycles(StallCause::kIdle), 1000U);
  EXPECT_EQ(account.total(), 1000U);
}

TEST(StallAccount, EachIntervalGoesToTheCauseThatItBeganWith) {
  StallAccount account;
  account.switch_to(StallCause::kBusy, 5);
  account.switch_to(StallCause::kWaitingMemory, 7);
  account.switch_to(StallCause::kBusy, 107);
  account.switch_to(StallCause::kBlockedOutput, 108);
  account.switch_to(StallCause::kWaitingInput, 111);
  account.finish(120);
  EXPECT_EQ(account.cycles(StallCause::kIdle), 5U);
  EXPECT_EQ(account.cycles(StallCause::kBusy), 3U);
  EXPECT_EQ(account.cycles(StallCause::kWaitingMemory), 100U);
  EXPECT_EQ(account.cycles(StallCause::kBlockedOutput), 3U);
  EXPECT_EQ(account.cycles(StallCause::kWaitingInput), 9U);
}

TEST(StallAccount, TheLastSwitchInACycleGetsIt) {
  StallAccount account;
  account.switch_to(StallCause::kBusy, 0);
  account.switch_to(StallCause::kWaitingInput, 0);
  account.finish(1);
  EXPECT_EQ(account.cycles(StallCause::kBusy), 0U);
  EXPECT_EQ(account.cycles(StallCause::kWaitingInput), 1U);
}

TEST(StallAccount, SwitchingToTheSameCauseChangesNothing) {
  StallAccount account;
  account.switch_to(StallCause::kBusy, 0);
  account.switch_to(StallCause::kBusy, 3);
  account.finish(10);
  EXPECT_EQ(account.cycles(StallCause::kBusy), 10U);
}

TEST(StallAccount, TellsWhetherTimeWentBack) {
  StallAccount account;
  account.switch_to(StallCause::kBusy, 10);
  account.switch_to(StallCause::kIdle, 10);
  EXPECT_TRUE(account.is_ordered());
  account.switch_to(StallCause::kBusy, 9);
  account.finish(20);
  EXPECT_FALSE(account.is_ordered());
}

TEST(StallAccount, CausesSumToTheRunWhateverTheSwitches) {
  Random random(7);
  StallAccount account;
  Cycles now = 0;
  for (int i = 0; i < 10000; ++i) {
    now += random.below(4) == 0 ? random.below(1'000'000) : random.below(3);
    account.switch_to(static_cast<StallCause>(random.below(kNumStallCauses)), now);
    ASSERT_EQ(account.total(), now);
  }
  account.finish(now + 17);
  EXPECT_EQ(account.total(), now + 17);
}

}  // namespace
}  // namespace sheaf
