// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/random.h"
#include "config/config.h"

namespace sheaf::test {

inline UnitSpec random_unit(Random& random) {
  UnitSpec spec;
  spec.count = 1;
  spec.contexts = 1 + static_cast<std::uint32_t>(random.below(8));
  spec.lanes = 1U << random.below(5);
  spec.initiation_interval = 1 + random.below(3);
  spec.latency = 1 + random.below(10);
  return spec;
}

/// Small, so that it misses; in one of four cases it is not there at all.
inline CacheSpec random_cache(Random& random) {
  CacheSpec spec;
  spec.mode = random.below(4) == 0 ? CacheMode::kAbsent : CacheMode::kNormal;
  spec.line = 16U << random.below(3);
  spec.ways = 2;
  spec.capacity = spec.line * spec.ways * 8;
  spec.mshrs = 1 + static_cast<std::uint32_t>(random.below(4));
  spec.hit_latency = 1 + random.below(3);
  return spec;
}

}  // namespace sheaf::test
