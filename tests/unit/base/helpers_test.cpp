// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "base/helpers.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <fstream>

namespace sheaf {
namespace {

TEST(Helpers, DoTheWorkAndAreDoneWhenTheyAreGone) {
  std::atomic<int> done = 0;
  {
    const auto helpers = start_helpers(3, [&] { ++done; });
  }
  EXPECT_EQ(done, 3);
}

/// Addresses that the process uses, in bytes.
std::size_t address_space() {
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0;
  file >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// Stacks are addresses, of which sanitizers need more than there would be.
TEST(Helpers, AreAsManyAsThePeakMemoryAllowsAndNoError) {
  constexpr unsigned kWanted = 64;
  const rlimit few{address_space() + (std::size_t{64} << 20U), RLIM_INFINITY};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &few), 0);
  std::atomic<bool> go = false;
  const auto helpers = start_helpers(kWanted, [&] { go.wait(false); });
  EXPECT_LT(helpers.size(), kWanted);
  go = true;
  go.notify_all();
}

}  // namespace
}  // namespace sheaf
