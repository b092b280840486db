// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "config/config.h"
#include "memory/cache_array.h"
#include "tracefile/memory_stream.h"

namespace sheaf {

/// One request for a line.
struct LineAccess {
  Address address = 0;
  Cycles cycle = 0;
  Bytes bytes = 0;
  bool write = false;
};

/// What is left of a memory trace's accesses for DRAM behind the caches of a configuration. The
/// caches take their lines in at once and in the order of the recorded cycles, so that no miss
/// merges with another, and a request has the cycle of the access that caused it; modified lines
/// are written back when they are pushed out, and in the end.
class DramRequests {
 public:
  using Sink = std::function<void(const LineAccess&)>;

  /// Throws Error(kTrace) for a cache that the configuration does not have.
  DramRequests(const Config& config, const MemoryLayout& layout, Sink sink);

  void add(const MemoryAccesses::Access& access);
  void finish();

 private:
  struct Level {
    CacheMode mode{};
    Bytes line = 0;
    CacheArray array;
  };
  void access_private(Level& cache, std::uint64_t line, bool write);
  void access_shared(Address address, Bytes bytes, bool write);
  void send(Address address, Bytes bytes, bool write) { sink_({address, cycle_, bytes, write}); }

  Sink sink_;
  std::vector<std::vector<Level>> private_;  ///< by stream and cache
  Level shared_;
  Cycles cycle_ = 0;
};

/// The parameters of a recorded cache; null for a group that there is not.
[[nodiscard]] const CacheSpec* find_cache(const Config& config, std::string_view group);

}  // namespace sheaf
