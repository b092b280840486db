// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "channels/timing_wheel.h"

#include <gtest/gtest.h>

#include <array>

#include "base/random.h"

namespace sheaf {
namespace {

TEST(TimingWheel, IsEmptyAtFirst) {
  TimingWheel wheel;
  EXPECT_EQ(wheel.peek(), kNever);
}

TEST(TimingWheel, GivesAgentsOfOneCycleInAscendingOrder) {
  TimingWheel wheel;
  wheel.schedule(63, 5);
  wheel.schedule(0, 5);
  wheel.schedule(7, 5);
  ASSERT_EQ(wheel.peek(), 5U);
  EXPECT_EQ(wheel.pop(5), 0U);
  EXPECT_EQ(wheel.pop(5), 7U);
  EXPECT_EQ(wheel.pop(5), 63U);
  EXPECT_EQ(wheel.peek(), kNever);
}

TEST(TimingWheel, KeepsTheEarlierOfTwoTimes) {
  TimingWheel wheel;
  wheel.schedule(3, 9);
  wheel.schedule(3, 12);
  EXPECT_EQ(wheel.peek(), 9U);
  wheel.schedule(3, 4);
  EXPECT_EQ(wheel.peek(), 4U);
  wheel.pop(4);
  EXPECT_EQ(wheel.peek(), kNever);
}

TEST(TimingWheel, HoldsTimesBeyondItsSlots) {
  TimingWheel wheel;
  constexpr Cycles kFar = 1'000'000'000'000;
  wheel.schedule(1, kFar);
  wheel.schedule(2, kFar + TimingWheel::kSlots);
  wheel.schedule(3, 10);
  EXPECT_EQ(wheel.pop(wheel.peek()), 3U);
  ASSERT_EQ(wheel.peek(), kFar);
  EXPECT_EQ(wheel.pop(kFar), 1U);
  EXPECT_EQ(wheel.peek(), kFar + TimingWheel::kSlots);
}

TEST(TimingWheel, ForgetsACancelledAgentNearAndFar) {
  TimingWheel wheel;
  wheel.schedule(1, 5);
  wheel.schedule(2, 5000);
  wheel.cancel(1);
  EXPECT_EQ(wheel.peek(), 5000U);
  wheel.cancel(2);
  EXPECT_EQ(wheel.peek(), kNever);
}

TEST(TimingWheel, AgreesWithASearchOverAllAgents) {
  TimingWheel wheel;
  std::array<Cycles, TimingWheel::kMaxAgents> due{};
  due.fill(kNever);
  Random random(1);
  Cycles now = 0;
  for (int step = 0; step < 200'000; ++step) {
    const auto agent = random.below(TimingWheel::kMaxAgents);
    // Mostly near times, some just around the end of the slots, some far.
    const std::uint64_t spread = random.below(3) == 0 ? 2 * TimingWheel::kSlots : 20;
    const Cycles time = now + random.below(random.below(50) == 0 ? 100'000 : spread);
    wheel.schedule(agent, time);
    if (time < due[agent]) due[agent] = time;
    if (random.below(2) == 0) continue;
    std::size_t first = 0;
    for (std::size_t i = 0; i < due.size(); ++i) {
      if (due[i] < due[first]) first = i;
    }
    ASSERT_EQ(wheel.peek(), due[first]);
    if (due[first] == kNever) continue;
    now = due[first];
    ASSERT_EQ(wheel.pop(now), first);
    due[first] = kNever;
  }
}

}  // namespace
}  // namespace sheaf
