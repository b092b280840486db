// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "memory/private_cache.h"

namespace sheaf {

/// The lines of a cache that an access touches, appended.
inline void add_lines(Address first, Bytes bytes, const PrivateCache& cache,
                      std::vector<std::uint64_t>& lines) {
  for (std::uint64_t line = cache.line_of(first); line <= cache.line_of(first + bytes - 1);
       ++line) {
    lines.push_back(line);
  }
}

/// A step asks for each line once, in ascending order.
inline void keep_each_once(std::vector<std::uint64_t>& lines) {
  std::ranges::sort(lines);
  const auto repeated = std::ranges::unique(lines);
  lines.erase(repeated.begin(), repeated.end());
}

}  // namespace sheaf
