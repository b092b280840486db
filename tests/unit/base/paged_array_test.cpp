// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "base/paged_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

namespace sheaf {
namespace {

constexpr std::size_t kSize = 8'000'000;  // 32 MB of numbers

std::uint32_t number(std::size_t i) {
  return static_cast<std::uint32_t>(i * 2654435761U);
}

std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0;
  std::size_t resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(PagedArray, StartsAsZeros) {
  for (const std::size_t in_memory : {std::size_t{0}, std::size_t{1} << 20U}) {
    const PagedArray<std::uint32_t> numbers(1000, in_memory);
    for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], 0U);
  }
}

TEST(PagedArray, KeepsWhatHasLeftMemory) {
  PagedArray<std::uint32_t> numbers(kSize, 0);
  for (std::size_t i = 0; i < kSize; ++i) numbers[i] = number(i);
  for (std::size_t i = 0; i < kSize; ++i) ASSERT_EQ(numbers[i], number(i));
}

TEST(PagedArray, TakesLittleMemoryWhileItIsFilledAndRead) {
  PagedArray<std::uint32_t> numbers(kSize, 0);
  const std::size_t before = resident_bytes();
  std::size_t most = 0;
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < 2 * kSize; ++i) {
    if (i < kSize) {
      numbers[i] = number(i);
    } else {
      sum += numbers[i - kSize];
    }
    if (i % 100'000 == 0) most = std::max(most, resident_bytes());
  }
  EXPECT_NE(sum, 0U);
  EXPECT_LE(most, before + (std::size_t{4} << 20U));
}

TEST(PagedArray, SaysWhereThereIsNoRoom) {
  const char* const old = std::getenv("TMPDIR");
  const std::string folder = old == nullptr ? "" : old;
  const std::string gone = testing::TempDir() + "sheaf_no_such_folder";
  setenv("TMPDIR", gone.c_str(), 1);
  try {
    const PagedArray<std::uint32_t> numbers(1000, 0);
    ADD_FAILURE() << "it was made";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kOutput);
    EXPECT_STREQ(error.what(),
                 "the folder for temporary files: no room for the pixels of a large picture: No "
                 "such file or directory; TMPDIR names another folder");
  }
  if (old == nullptr) {
    unsetenv("TMPDIR");
  } else {
    setenv("TMPDIR", folder.c_str(), 1);
  }
}

}  // namespace
}  // namespace sheaf
