// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/data_kind.h"
#include "base/units.h"

namespace sheaf {

/// A private cache as a memory trace names it.
struct MemoryTraceCache {
  std::string name;   ///< in the report, below its unit: node_cache
  std::string group;  ///< of the parameters that describe it: node_cache
};

/// The accesses of one unit: its contexts take turns on one issue port.
struct MemoryTraceStream {
  std::string name;            ///< the unit's, for example traversal_unit0
  std::string group;           ///< units that can do the same work: traversal_unit
  std::uint32_t contexts = 1;  ///< 1 to 64
  Cycles turnaround = 0;       ///< from the end of a context's chain to the next one's beginning
  Cycles retry_interval = 1;   ///< port cycles of a step that found a line missing
  bool awaited = true;         ///< others wait for it; else it only takes in (the film)
  std::vector<MemoryTraceCache> caches = {};
};

/// What a record does; records of the same kind share an entry.
struct MemoryOperation {
  std::uint8_t cache = 0;         ///< of the stream's caches
  DataKind kind{};                ///< of the data
  std::uint32_t bytes = 0;        ///< 0: nothing is accessed, the step only takes time
  bool write = false;             ///< read-modify-write; nobody waits for the line
  bool calls = false;             ///< the context goes on when the chain that this causes has ended
  std::uint32_t port_cycles = 1;  ///< at least, that the step occupies the issue port
  std::uint32_t latency = 0;      ///< of the unit, behind that of the cache
  bool operator==(const MemoryOperation&) const = default;
};

/// What the records of a memory trace refer to.
struct MemoryLayout {
  std::vector<MemoryTraceStream> streams;
  std::vector<MemoryOperation> operations;
  Cycles answer_latency = 1;  ///< from the end of a called chain to its caller's going on
};

}  // namespace sheaf
