// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Source, arbiter, ray cache and spawn router of both models, side by side.

#include "timing/both_models.h"
#include "units/clocked/packet_arbiter.h"
#include "units/clocked/primary_source.h"
#include "units/clocked/ray_cache.h"
#include "units/clocked/spawn_router.h"
#include "units/packet_arbiter.h"
#include "units/primary_source.h"
#include "units/ray_cache_unit.h"
#include "units/spawn_router.h"

namespace sheaf::test {
namespace {

constexpr Cycles kLatency = 4;
constexpr int kPacketSize = 8;
constexpr std::size_t kUnbounded = clocked::Link<int>::kUnbounded;

std::uint64_t num_rays(const RayPacket& packet) {
  return static_cast<std::uint64_t>(std::popcount(packet.active));
}

void fill_bundle(SpawnBundle& bundle, Random& random) {
  bundle.begin_group();
  const std::uint64_t reflections = 1 + random.below(kPacketSize);
  for (std::uint64_t i = 0; i < 2 * reflections; ++i) {
    if (i == reflections) bundle.begin_group();
    Ray ray;
    for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = random.uniform() - 0.5F;
    ray.tag.id = random.next();
    ray.tag.kind = i < reflections ? RayKind::kReflection : RayKind::kShadow;
    bundle.add(ray, static_cast<int>(i % reflections));
  }
}

/// Ray cache or spawn router.
template <typename M, bool kSorts>
struct RegrouperBench {
  explicit RegrouperBench(std::uint64_t seed) : bench(seed) {
    in = &bench.template to_unit<SpawnBundle*>("in", {.capacity = kUnbounded, .latency = kLatency});
    out = &bench.template from_unit<RayPacket*>(
        "out", {.capacity = 1 + bench.random.below(4), .latency = kLatency});
    spec.rays_per_cycle = 1 + static_cast<std::uint32_t>(bench.random.below(5));
    spec.timeout = bench.random.below(2) * 150;
    SorterOptions options;
    options.heuristic = HeuristicChoice::parse("mdir(24)");
    options.num_cells = 2 + static_cast<std::uint32_t>(bench.random.below(12));
    options.victim = static_cast<VictimPolicy>(bench.random.below(3));
    auto sorter = make_sorter(options, Box{Vec3(0.0F), Vec3(1.0F)}, packets);
    if constexpr (M::kTimed && kSorts) {
      unit = std::make_unique<Unit>("unit", spec, std::move(sorter), bundles, flow, *bench.domain);
    } else if constexpr (M::kTimed) {
      unit = std::make_unique<Unit>("unit", packets, bundles, *bench.domain);
    } else if constexpr (kSorts) {
      unit = std::make_unique<Unit>("unit", spec, std::move(sorter), bundles, flow);
    } else {
      unit = std::make_unique<Unit>("unit", packets, bundles);
    }
    if constexpr (M::kTimed) {
      unit->in_bundles(*in);
      unit->out_packets(*out);
    } else {
      unit->in_bundles = in;
      unit->out_packets = out;
    }
    bench.act = [this](Cycles now) { act(now); };
  }

  void act(Cycles now) {
    using Source = FlowControl::Source;
    const bool last = now > kLastAction / 2;
    if (!last && bench.random.below(12) == 0) {
      SpawnBundle* bundle = bundles.acquire();
      fill_bundle(*bundle, bench.random);
      flow.admit(bundle->rays.size(), 0, now);
      UnitBench<M>::template write<SpawnBundle*>(*in, bundle, now);
    }
    flow.set_source(last || bench.random.below(2) == 0 ? Source::kTileIssued : Source::kIssuing,
                    now);
    if (!out->has_arrived(now) || (!last && bench.random.below(3) == 0)) return;
    RayPacket* packet = out->read(now);
    std::uint64_t all = 0;
    for (LaneMask left = packet->active; left != 0; left &= left - 1) {
      all ^= packet->tag[static_cast<std::size_t>(std::countr_zero(left))].id;
    }
    bench.note("packet", now, num_rays(*packet), all);
    flow.replace(num_rays(*packet), 0, 0, 0, now);
    packets.release(packet);
  }

  void run_to_end() {
    bench.run_unit(*unit);
    EXPECT_EQ(flow.live(), 0U);
    if constexpr (kSorts) {
      bench.note_counters(unit->sorter().stats());
    } else {
      bench.note_counters(unit->stats());
    }
    bench.note("made", packets.num_made());
    bench.note_stalls(*unit);
  }

  using Timed = std::conditional_t<kSorts, RayCacheUnit, SpawnRouter>;
  using Clocked = std::conditional_t<kSorts, clocked::RayCache, clocked::SpawnRouter>;
  using Unit = std::conditional_t<M::kTimed, Timed, Clocked>;
  UnitBench<M> bench;
  RayCacheSpec spec;
  PacketPool packets{kPacketSize};
  ObjectPool<SpawnBundle> bundles;
  FlowControl flow{FlowSpec{}, WorstCase(1, 1, 1), 0};
  typename M::template Link<SpawnBundle*>* in = nullptr;
  typename M::template Link<RayPacket*>* out = nullptr;
  std::unique_ptr<Unit> unit;
};

template <typename M>
using RayCacheBench = RegrouperBench<M, true>;
template <typename M>
using SpawnRouterBench = RegrouperBench<M, false>;

template <typename M>
struct ArbiterBench {
  static constexpr std::uint32_t kUnits = 3;

  explicit ArbiterBench(std::uint64_t seed) : bench(seed) {
    const ArbiterSpec spec{static_cast<ArbiterPolicy>(bench.random.below(3))};
    UnitSpec traversal;
    traversal.count = kUnits;
    traversal.contexts = 1 + static_cast<std::uint32_t>(bench.random.below(3));
    primary = &bench.template to_unit<RayPacket*>("primary", {.capacity = 3, .latency = kLatency});
    secondary = &bench.template to_unit<RayPacket*>("secondary", {.capacity = 5, .latency = 2});
    free = &bench.template to_unit<ContextFree>(
        "free", {.capacity = kUnbounded, .latency = kLatency, .interval = 0});
    for (const char* name : {"out0", "out1", "out2"}) {
      out.push_back(&bench.template from_unit<RayPacket*>(
          name, {.capacity = kUnbounded, .latency = kLatency}));
    }
    if constexpr (M::kTimed) {
      unit = std::make_unique<Unit>("unit", spec, kUnits, traversal.contexts, *bench.domain);
      unit->in_primary(*primary);
      unit->in_secondary(*secondary);
      unit->in_free(*free);
      for (auto* link : out) unit->out_packets(*link);
    } else {
      unit = std::make_unique<Unit>("unit", spec, traversal);
      unit->in_primary = primary;
      unit->in_secondary = secondary;
      unit->in_free = free;
      unit->out_packets = out;
    }
    bench.act = [this](Cycles now) { act(now); };
  }

  void act(Cycles now) {
    for (auto* link : {primary, secondary}) {
      if (bench.random.below(3) != 0) continue;
      RayPacket* packet = packets.acquire();
      packet->put(0, {});
      packet->tag[0].id = next++;
      if (!UnitBench<M>::template write<RayPacket*>(*link, packet, now)) packets.release(packet);
    }
    for (std::uint16_t i = 0; i < kUnits; ++i) {
      while (out[i]->has_arrived(now)) {
        RayPacket* packet = out[i]->read(now);
        bench.note("packet", now, i, packet->tag[0].id);
        packets.release(packet);
        held.push_back(i);
      }
    }
    if (held.empty() || bench.random.below(4) == 0) return;
    const auto done = held.begin() + static_cast<std::ptrdiff_t>(bench.random.below(held.size()));
    UnitBench<M>::template write<ContextFree>(*free, {*done}, now);
    held.erase(done);
  }

  void run_to_end() {
    bench.run_unit(*unit);
    bench.note_counters(unit->stats());
    bench.note_stalls(*unit);
  }

  using Unit = std::conditional_t<M::kTimed, PacketArbiter, clocked::PacketArbiter>;
  template <typename T>
  using Link = typename M::template Link<T>;
  UnitBench<M> bench;
  PacketPool packets{kPacketSize};
  std::uint64_t next = 0;
  std::vector<std::uint16_t> held;  ///< units that a packet is in
  Link<RayPacket*>* primary = nullptr;
  Link<RayPacket*>* secondary = nullptr;
  Link<ContextFree>* free = nullptr;
  std::vector<Link<RayPacket*>*> out;
  std::unique_ptr<Unit> unit;
};

template <typename M>
struct SourceBench {
  explicit SourceBench(std::uint64_t seed) : bench(seed) {
    const PrimarySourceSpec spec{1 + bench.random.below(10)};
    FlowSpec flow_spec;
    flow_spec.control = bench.random.below(2) == 0 ? FlowPolicy::kTile : FlowPolicy::kCredits;
    flow = std::make_unique<FlowControl>(flow_spec, WorstCase(1, 1, 1), 100);
    ImageSpec image;
    image.width = 37;
    image.height = 29;
    const TileOrder order(image.width, image.height, 16, kPacketSize);
    out = &bench.template from_unit<RayPacket*>(
        "out", {.capacity = 1 + bench.random.below(5), .latency = kLatency});
    if constexpr (M::kTimed) {
      unit = std::make_unique<Unit>("unit", spec, image, order, camera, packets, rays, *flow,
                                    *bench.domain);
      unit->out_packets(*out);
    } else {
      unit = std::make_unique<Unit>("unit", spec, image, order, camera, packets, rays, *flow);
      unit->out_packets = out;
    }
    bench.act = [this](Cycles now) { act(now); };
  }

  void act(Cycles now) {
    if (out->has_arrived(now) && bench.random.below(3) != 0) {
      RayPacket* packet = out->read(now);
      bench.note("packet", now, packet->active, packet->tag[0].pixel);
      tracing.push_back(num_rays(*packet));
      packets.release(packet);
    }
    if (tracing.empty() || bench.random.below(3) == 0) return;
    flow->replace(tracing.back(), 0, 2 * tracing.back(), 0, now);
    tracing.pop_back();
  }

  void run_to_end() {
    bench.run_unit(*unit);
    EXPECT_TRUE(flow->finished());
    bench.note_counters(unit->stats());
    bench.note("packets", packets.num_made(), rays.total().spawned);
    bench.note_stalls(*unit);
  }

  using Unit = std::conditional_t<M::kTimed, PrimarySource, clocked::PrimarySource>;
  UnitBench<M> bench;
  Camera camera;
  PacketPool packets{kPacketSize};
  RayCounts rays{1};
  std::unique_ptr<FlowControl> flow;
  std::vector<std::uint64_t> tracing;  ///< rays of each packet
  typename M::template Link<RayPacket*>* out = nullptr;
  std::unique_ptr<Unit> unit;
};

class SortingUnits : public BothModels {};

TEST_P(SortingUnits, RayCacheIsTheSame) {
  expect_both_alike<RayCacheBench>(GetParam());
}
TEST_P(SortingUnits, SpawnRouterIsTheSame) {
  expect_both_alike<SpawnRouterBench>(GetParam());
}
TEST_P(SortingUnits, PacketArbiterIsTheSame) {
  expect_both_alike<ArbiterBench>(GetParam());
}
TEST_P(SortingUnits, PrimarySourceIsTheSame) {
  expect_both_alike<SourceBench>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Seeds, SortingUnits, testing::Range<std::uint64_t>(0, 6));

}  // namespace
}  // namespace sheaf::test
