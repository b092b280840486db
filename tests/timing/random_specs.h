// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

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

/// What every cache can choose, each of its options in half of the cases.
template <typename Spec>
void choose_options(Random& random, Spec& spec) {
  const auto power = [&](std::uint64_t most) {
    return random.below(2) == 0 ? 1U : 1U << random.below(most + 1);
  };
  spec.mode = random.below(4) == 0 ? CacheMode::kAbsent : CacheMode::kNormal;
  spec.ways = 2;
  spec.sectors = std::min(power(2), static_cast<std::uint32_t>(spec.line / 16));
  spec.banks = power(2);
  spec.ports = power(1);
  spec.mshrs = 1 + static_cast<std::uint32_t>(random.below(4));
  spec.mshr_targets = random.below(2) == 0 ? 0 : 1 + static_cast<std::uint32_t>(random.below(3));
  spec.replacement = static_cast<Replacement>(random.below(4));
}

inline void choose_writes(Random& random, WriteSpec& spec) {
  spec.policy = random.below(2) == 0 ? WritePolicy::kBack : WritePolicy::kThrough;
  spec.allocate = random.below(2) == 0;
  spec.buffer = random.below(2) == 0 ? 0 : 1 + static_cast<std::uint32_t>(random.below(3));
}

/// Small, so that it misses.
inline CacheSpec random_cache(Random& random) {
  CacheSpec spec;
  spec.line = 16U << random.below(3);
  choose_options(random, spec);
  spec.capacity = spec.line * spec.ways * 8;
  spec.hit_latency = 1 + random.below(3);
  return spec;
}

}  // namespace sheaf::test
