// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "channels/clock_domain.h"
#include "channels/timed_channel.h"
#include "config/config.h"
#include "memory/l2_cache.h"
#include "memory/main_memory.h"
#include "system/memory_parts.h"

namespace sheaf {

[[nodiscard]] sc_core::sc_time clock_period(const Config& config);

/// The memory of a machine that goes from event to event: what stands behind its private caches,
/// which all ask through one link.
class MemorySystem : public MemoryParts<TimedChannel, L2Cache, MainMemory> {
 public:
  MemorySystem(const Config& config, ClockDomain& domain);

  /// Makes the link that brings pieces of `bytes` to one more requester; returns its number at the
  /// L2.
  [[nodiscard]] std::uint16_t add_requester(Bytes bytes);
  /// The same for a private cache.
  [[nodiscard]] std::uint16_t add_requester(const CacheSpec& cache) {
    return add_requester(cache.line / cache.sectors);
  }
  /// The link of that number.
  [[nodiscard]] TimedChannel<LineResponse>& lines(std::uint16_t requester) {
    return *lines_[requester];
  }
  [[nodiscard]] TimedOut<LineRequest>& requests() { return *requests_.front(); }
};

}  // namespace sheaf
