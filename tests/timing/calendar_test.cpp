// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "channels/calendar.h"

#include <gtest/gtest.h>

#include <array>

#include "base/errors.h"
#include "base/random.h"

namespace sheaf {
namespace {

Calendar calendar_of(std::size_t num_agents) {
  Calendar calendar;
  for (std::size_t i = 0; i < num_agents; ++i) EXPECT_EQ(calendar.add(), i);
  return calendar;
}

TEST(Calendar, IsEmptyAtFirst) {
  EXPECT_EQ(Calendar().next(), kNever);
  EXPECT_EQ(calendar_of(3).next(), kNever);
}

TEST(Calendar, GivesAgentsOfOneCycleInAscendingOrder) {
  Calendar calendar = calendar_of(64);
  calendar.schedule(63, 5);
  calendar.schedule(0, 5);
  calendar.schedule(7, 5);
  ASSERT_EQ(calendar.next(), 5U);
  EXPECT_EQ(calendar.pop(), 0U);
  EXPECT_EQ(calendar.pop(), 7U);
  EXPECT_EQ(calendar.pop(), 63U);
  EXPECT_EQ(calendar.next(), kNever);
}

TEST(Calendar, KeepsTheEarlierOfTwoTimes) {
  Calendar calendar = calendar_of(4);
  calendar.schedule(3, 9);
  calendar.schedule(3, 12);
  EXPECT_EQ(calendar.next(), 9U);
  calendar.schedule(3, 4);
  EXPECT_EQ(calendar.next(), 4U);
  calendar.pop();
  EXPECT_EQ(calendar.next(), kNever);
}

TEST(Calendar, NeverComesForWhoIsDueNever) {
  Calendar calendar = calendar_of(2);
  calendar.schedule(0, kNever);
  EXPECT_EQ(calendar.next(), kNever);
  calendar.schedule(0, Calendar::kEndOfTime - 1);
  EXPECT_EQ(calendar.next(), Calendar::kEndOfTime - 1);
}

TEST(Calendar, RefusesWhatIsDueWhereTimeHasEnded) {
  Calendar calendar = calendar_of(1);
  try {
    calendar.schedule(0, Calendar::kEndOfTime);
    ADD_FAILURE() << "taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_TRUE(std::string(error.what()).starts_with("cycle 4503599627370496: ")) << error.what();
  }
  EXPECT_THROW(calendar.schedule(0, kNever - 1), Error);
}

TEST(Calendar, AgreesWithASearchOverAllAgents) {
  constexpr std::size_t kAgents = 150;
  Calendar calendar = calendar_of(kAgents);
  std::array<Cycles, kAgents> due{};
  due.fill(kNever);
  Random random(1);
  Cycles now = 0;
  for (int step = 0; step < 100'000; ++step) {
    const auto agent = random.below(kAgents);
    const Cycles time = now + random.below(random.below(50) == 0 ? 1'000'000'000 : 20);
    calendar.schedule(agent, time);
    if (time < due[agent]) due[agent] = time;
    if (random.below(2) == 0) continue;
    std::size_t first = 0;
    for (std::size_t i = 0; i < due.size(); ++i) {
      if (due[i] < due[first]) first = i;
    }
    ASSERT_EQ(calendar.next(), due[first]);
    now = due[first];
    ASSERT_EQ(calendar.pop(), first);
    due[first] = kNever;
  }
}

}  // namespace
}  // namespace sheaf
