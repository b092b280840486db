// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sheaf {

/// Room for `count` values in all, on pages of 2 MB where the system has them: one page fault fills
/// as much as 512 did.
template <typename T>
void reserve_on_huge_pages(std::vector<T>& values, std::size_t count) {
  constexpr std::uintptr_t kPage = 4096;
  constexpr std::uintptr_t kHugePage = 2U << 20U;
  values.reserve(count);
  const std::size_t bytes = values.capacity() * sizeof(T);
  const std::size_t before = -reinterpret_cast<std::uintptr_t>(values.data()) % kPage;
  if (bytes < before + kHugePage) return;
  // Only advice: without it everything works as well.
  madvise(reinterpret_cast<char*>(values.data()) + before, bytes - before, MADV_HUGEPAGE);
}

}  // namespace sheaf
