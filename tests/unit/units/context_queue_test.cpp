// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/context_queue.h"

#include <gtest/gtest.h>

#include <map>

#include "base/random.h"

namespace sheaf {
namespace {

TEST(ContextAgenda, IsEmptyAtFirst) {
  EXPECT_EQ(ContextAgenda().next(), kNever);
}

TEST(ContextAgenda, GivesContextsByTimeAndThenByNumber) {
  ContextAgenda agenda;
  agenda.insert(63, 7);
  agenda.insert(5, 7);
  agenda.insert(9, 3);
  EXPECT_EQ(agenda.next(), 3U);
  EXPECT_EQ(agenda.pop(), 9);
  EXPECT_EQ(agenda.pop(), 5);
  EXPECT_EQ(agenda.pop(), 63);
  EXPECT_EQ(agenda.next(), kNever);
}

TEST(ContextAgenda, HoldsEveryContextWhateverTheOrder) {
  Random random(3);
  ContextAgenda agenda;
  for (int round = 0; round < 1000; ++round) {
    std::multimap<Cycles, int> expected;
    for (int context = 0; context < 64; ++context) {
      const Cycles time = random.below(Calendar::kEndOfTime);
      agenda.insert(context, time);
      expected.emplace(time, context);
    }
    for (const auto& [time, context] : expected) {
      ASSERT_EQ(agenda.next(), time);
      ASSERT_EQ(agenda.pop(), context);
    }
  }
}

TEST(ReadyQueue, ServesFirstWhoCameFirst) {
  ReadyQueue queue;
  for (int round = 0; round < 300; ++round) {
    queue.push(63);
    queue.push(0);
    EXPECT_EQ(queue.pop(), 63);
    EXPECT_EQ(queue.pop(), 0);
    EXPECT_TRUE(queue.is_empty());
  }
}

}  // namespace
}  // namespace sheaf
