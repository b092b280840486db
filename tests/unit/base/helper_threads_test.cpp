// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "base/helper_threads.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>

namespace sheaf {
namespace {

TEST(HelperThreads, AllDoTheWork) {
  std::atomic<int> done = 0;
  start_helpers(3, [&] { ++done; }).clear();
  EXPECT_EQ(done, 3);
}

// Named with PeakMemory, which sanitizers leave out: they end a process that has no room for a
// thread.
TEST(HelperThreadsPeakMemory, ThereAreNoneWhereAddressSpaceHasNoRoomForTheirStacks) {
  const rlimit none{.rlim_cur = 1, .rlim_max = RLIM_INFINITY};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &none), 0);
  const std::size_t started = start_helpers(3, [] {}).size();
  const rlimit all{.rlim_cur = RLIM_INFINITY, .rlim_max = RLIM_INFINITY};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &all), 0);
  EXPECT_EQ(started, 0U);
}

}  // namespace
}  // namespace sheaf
