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
  const auto begin = reinterpret_cast<std::uintptr_t>(values.data());
  const std::uintptr_t first_page = (begin + kPage - 1) / kPage * kPage;
  const std::uintptr_t end = begin + values.capacity() * sizeof(T);
  if (end < first_page + kHugePage) return;
  // Only advice: without it everything works as well.
  madvise(reinterpret_cast<void*>(first_page), end - first_page, MADV_HUGEPAGE);
}

}  // namespace sheaf
