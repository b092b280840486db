// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// One pass of stack distances beside twelve simulations, one for each cache size, over the same
// accesses: all lines of 64 bytes of a megabyte of distinct ones, uniformly random (the hardest
// stream: no locality at all) or with four in five accesses to one line in five. Accesses a second.
#include <benchmark/benchmark.h>

#include <list>
#include <random>
#include <unordered_map>
#include <vector>

#include "memory/cache_array.h"
#include "stats/stack_distance.h"

namespace sheaf::bench {
namespace {

constexpr std::size_t kAccesses = 4'000'000;
constexpr std::uint64_t kDistinct = 1 << 20;
constexpr int kNumSizes = 12;

std::vector<std::uint64_t> make_lines(bool skewed) {
  std::mt19937_64 random(1);
  std::vector<std::uint64_t> lines(kAccesses);
  for (std::uint64_t& line : lines) {
    const std::uint64_t range = skewed && random() % 5 != 0 ? kDistinct / 5 : kDistinct;
    line = random() % range;
  }
  return lines;
}

void one_pass(benchmark::State& state) {
  const auto lines = make_lines(state.range(0) != 0);
  const auto num_sets = static_cast<std::uint32_t>(state.range(1));
  for (auto _ : state) {
    StackDistances distances(num_sets);
    MissCurve curve;
    distances.access_all(lines, [&](std::uint32_t distance) { curve.add(distance); });
    benchmark::DoNotOptimize(curve.points().back().misses);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * kAccesses));
}
BENCHMARK(one_pass)
    ->ArgNames({"skewed", "sets"})
    ->ArgsProduct({{0, 1}, {1, 64, 4096}})
    ->Unit(benchmark::kMillisecond);

/// A fully associative cache that replaces the line least recently used: a list in that order, and
/// where each line stands in it.
class AssociativeCache {
 public:
  explicit AssociativeCache(std::size_t num_lines) : num_lines_(num_lines) {
    places_.reserve(num_lines);
  }
  /// Whether the line was there; it is afterwards.
  bool touch(std::uint64_t line) {
    const auto found = places_.find(line);
    if (found != places_.end()) {
      order_.splice(order_.begin(), order_, found->second);
      return true;
    }
    if (places_.size() == num_lines_) {
      places_.erase(order_.back());
      order_.pop_back();
    }
    order_.push_front(line);
    places_.emplace(line, order_.begin());
    return false;
  }

 private:
  std::size_t num_lines_;
  std::list<std::uint64_t> order_;
  std::unordered_map<std::uint64_t, std::list<std::uint64_t>::iterator> places_;
};

// Sizes from 2^9 lines to 2^20: what a curve costs that takes one run a point.
void twelve_associative(benchmark::State& state) {
  const auto lines = make_lines(state.range(0) != 0);
  for (auto _ : state) {
    for (int size = 0; size < kNumSizes; ++size) {
      AssociativeCache cache(std::size_t{512} << size);
      std::uint64_t misses = 0;
      for (const std::uint64_t line : lines) misses += cache.touch(line) ? 0 : 1;
      benchmark::DoNotOptimize(misses);
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * kAccesses));
}
BENCHMARK(twelve_associative)->ArgName("skewed")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

// The same sizes with 8 ways.
void twelve_of_eight_ways(benchmark::State& state) {
  const auto lines = make_lines(state.range(0) != 0);
  for (auto _ : state) {
    for (int size = 0; size < kNumSizes; ++size) {
      CacheArray cache(std::uint32_t{64} << size, 8);
      std::uint64_t misses = 0;
      for (const std::uint64_t line : lines) {
        if (cache.touch(line)) continue;
        ++misses;
        cache.fill(line, false);
      }
      benchmark::DoNotOptimize(misses);
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * kAccesses));
}
BENCHMARK(twelve_of_eight_ways)->ArgName("skewed")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sheaf::bench

BENCHMARK_MAIN();
