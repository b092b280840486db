// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "config/config.h"
#include "system/tag_hierarchy.h"
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

  DramRequests(const DramRequests&) = delete;
  DramRequests& operator=(const DramRequests&) = delete;

  /// Throws Error(kTrace) for a write that no unit makes.
  void add(const MemoryAccesses::Access& access);
  void finish();

 private:
  struct PrivateCache {
    TagHierarchy::Cache kind;
    std::size_t unit;
  };

  TagHierarchy tags_;
  std::vector<std::vector<PrivateCache>> caches_;  ///< by stream and cache
  Cycles cycle_ = 0;
};

}  // namespace sheaf
