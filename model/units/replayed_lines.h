// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "memory/private_cache.h"
#include "tracefile/memory_layout.h"

namespace sheaf {

/// The lines of a cache that an access touches, appended.
inline void add_lines(Address first, Bytes bytes, const PrivateCache& cache,
                      std::vector<std::uint64_t>& lines) {
  for (std::uint64_t line = cache.line_of(first); line <= cache.line_of(first + bytes - 1);
       ++line) {
    lines.push_back(line);
  }
}

/// Adds to an access's bytes, line by line, from where it was left; false if the cache has no room.
inline bool modify_all(PrivateCache& cache, Address first, const MemoryOperation& operation,
                       int waiter, Bytes& done, Cycles now) {
  const Address end = first + operation.bytes;
  for (Address at = first + done; at != end; at = first + done) {
    const Bytes bytes = std::min<Address>(end, (cache.line_of(at) + 1) * cache.line_size()) - at;
    if (cache.modify(at, bytes, operation.kind, waiter, now) == PrivateCache::Result::kNoMshr) {
      return false;
    }
    done += bytes;
  }
  done = 0;
  return true;
}

/// A step asks for each line once, in ascending order.
inline void keep_each_once(std::vector<std::uint64_t>& lines) {
  std::ranges::sort(lines);
  const auto repeated = std::ranges::unique(lines);
  lines.erase(repeated.begin(), repeated.end());
}

}  // namespace sheaf
