// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// The queue of spawned rays that spills, of both models, side by side.

#include <deque>

#include "timing/both_models.h"
#include "units/clocked/spill_unit.h"

namespace sheaf::test {
namespace {

constexpr Cycles kLatency = 4;
constexpr std::size_t kNumBundles = 100;

template <typename M>
struct SpillBench {
  explicit SpillBench(std::uint64_t seed) : bench(seed) {
    spec.queue = 1 + static_cast<std::uint32_t>(bench.random.below(60));
    spec.line = 16U << bench.random.below(4);
    spec.base = 0x4000;
    in = &bench.template to_unit<SpawnBundle*>("in", {.capacity = 3, .latency = kLatency});
    out = &bench.template from_unit<SpawnBundle*>("out", {.capacity = 2, .latency = 1});
    if constexpr (M::kTimed) {
      unit = std::make_unique<Unit>("unit", spec, lines.requests, *bench.domain);
      unit->in_bundles(*in);
      unit->out_bundles(*out);
      unit->in_lines(lines.responses);
    } else {
      unit = std::make_unique<Unit>("unit", spec, lines.requests, lines.responses);
      unit->in_bundles = in;
      unit->out_bundles = out;
    }
    bench.act = [this](Cycles now) { act(now); };
  }

  void act(Cycles now) {
    lines.act(now);
    if (bundles.size() != kNumBundles && bench.random.below(3) == 0) {
      bundles.emplace_back();
      bundles.back().rays.resize(1 + bench.random.below(24));
      if (!UnitBench<M>::template write<SpawnBundle*>(*in, &bundles.back(), now)) {
        bundles.pop_back();
      }
    }
    // Sometimes slower than they come, so that the queue overflows, and in the end faster.
    const std::uint64_t gap = now > kLastAction / 2 ? 1 : 6;
    if (out->has_arrived(now) && bench.random.below(gap) == 0) {
      bench.note("bundle", now, out->read(now)->rays.size());
    }
  }

  void run_to_end() {
    bench.run_unit(*unit);
    EXPECT_TRUE(unit->is_idle());
    bench.note("sent", bundles.size());
    bench.note_counters(unit->stats());
    bench.note_stalls(*unit);
  }

  using Unit = std::conditional_t<M::kTimed, SpillUnit, clocked::SpillUnit>;
  UnitBench<M> bench;
  SpillUnit::Spec spec;
  CacheLinks<M> lines{bench, 0};
  std::deque<SpawnBundle> bundles;
  typename M::template Link<SpawnBundle*>* in = nullptr;
  typename M::template Link<SpawnBundle*>* out = nullptr;
  std::unique_ptr<Unit> unit;
};

class SpillingUnits : public BothModels {};

TEST_P(SpillingUnits, SpillUnitIsTheSame) {
  expect_both_alike<SpillBench>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Seeds, SpillingUnits, testing::Range<std::uint64_t>(0, 12));

}  // namespace
}  // namespace sheaf::test
