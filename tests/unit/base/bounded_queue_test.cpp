// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "base/bounded_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace sheaf {
namespace {

TEST(BoundedQueue, KeepsTheOrderAndNeverHoldsMoreThanItsCapacity) {
  constexpr int kCount = 10'000;
  constexpr int kCapacity = 3;
  BoundedQueue<int> queue(kCapacity);
  std::atomic<int> pushed = 0;
  std::thread producer([&] {
    for (int i = 0; i < kCount; ++i) {
      queue.push(i);
      ++pushed;
    }
    queue.close();
  });
  int popped = 0;
  while (const std::optional<int> item = queue.pop()) {
    EXPECT_EQ(*item, popped);
    ++popped;
    EXPECT_LE(pushed, popped + kCapacity);
  }
  producer.join();
  EXPECT_EQ(popped, kCount);
}

TEST(BoundedQueue, GivesWhatItHoldsAfterItIsClosed) {
  BoundedQueue<int> queue(2);
  queue.push(7);
  queue.close();
  EXPECT_EQ(queue.pop(), 7);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, GivesNothingMoreOnceItIsAbandoned) {
  BoundedQueue<int> queue(2);
  queue.push(7);
  queue.abandon();
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, LetsGoOfWhoWaitsForSomethingToCome) {
  BoundedQueue<int> queue(2);
  std::optional<int> item = 1;
  std::thread consumer([&] { item = queue.pop(); });
  queue.abandon();
  consumer.join();
  EXPECT_EQ(item, std::nullopt);
}

}  // namespace
}  // namespace sheaf
