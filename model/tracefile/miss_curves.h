// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "stats/stack_distance.h"
#include "tracefile/memory_stream.h"

namespace sheaf {

/// LRU misses of one stream of accesses in caches of all sizes.
struct MissCurveOfStream {
  std::string stream;  ///< all, a kind of data (node), or a recorded cache
  Bytes line = 64;
  std::uint32_t sets = 1;
  std::uint64_t num_accesses = 0;  ///< of lines: a step asks for each line once
  std::vector<MissCurve::Point> points;

  [[nodiscard]] Bytes capacity(std::uint64_t ways) const { return ways * sets * line; }
  [[nodiscard]] double miss_ratio(std::uint64_t ways) const;
};

/// The shapes of caches for which curves are made.
struct CurveShape {
  Bytes line = 64;         ///< a power of two
  std::uint32_t sets = 1;  ///< a power of two; 1: fully associative
};

/// One pass over a memory trace: for each shape, the curve of all accesses through one cache, of
/// each kind of data through a cache of its own, and of each recorded cache's accesses. `stop` is
/// asked now and then; once it says so, the curves are those of the accesses so far.
[[nodiscard]] std::vector<MissCurveOfStream> measure_miss_curves(
    MemoryAccesses& accesses, const MemoryLayout& layout, const std::vector<CurveShape>& shapes,
    const std::function<bool()>& stop = [] { return false; });

/// A capacity, a power of two, up to which doubling saves much and beyond which it saves little:
/// the last doubling saved at least kKneeShare of the accesses, and twice what the next one would.
struct Knee {
  Bytes capacity = 0;
  double miss_ratio = 0;
};
inline constexpr double kKneeShare = 0.02;
[[nodiscard]] std::vector<Knee> find_knees(const MissCurveOfStream& curve);

}  // namespace sheaf
