// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.h"
#include "system/memory_parts.h"
#include "units/clocked/cache.h"
#include "units/clocked/dram.h"
#include "units/clocked/l2_cache.h"
#include "units/clocked/link.h"

namespace sheaf {

/// The memory of a machine in which everything ticks in every cycle. Each private cache has a link
/// of its own to the L2.
class ClockedMemory : public MemoryParts<clocked::Link, clocked::L2Cache, clocked::Dram> {
 public:
  explicit ClockedMemory(const Config& config);

  /// Who asks the L2 for lines, with its links there and back.
  struct Requester {
    std::uint16_t number;
    clocked::Link<LineRequest>& requests;
    clocked::Link<LineResponse>& lines;
  };
  /// One more, for pieces of `bytes`.
  Requester add_requester(Bytes bytes);
  /// One more private cache.
  [[nodiscard]] clocked::Cache make_cache(const CacheSpec& spec);

  void tick(Cycles now);
  /// Brings what has been written, and may still be on its way, to memory.
  void drain(Cycles now);
};

}  // namespace sheaf
