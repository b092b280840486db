// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Traversal and intersection units of both models, side by side.

#include <deque>

#include "kdtree/memory_map.h"
#include "stability/mesh_scene.h"
#include "timing/both_models.h"
#include "timing/random_specs.h"
#include "units/clocked/intersection_unit.h"
#include "units/clocked/traversal_unit.h"
#include "units/intersection_unit.h"
#include "units/traversal_unit.h"

namespace sheaf::test {
namespace {

constexpr Cycles kLatency = 4;
constexpr std::size_t kUnbounded = clocked::Link<int>::kUnbounded;
constexpr int kPacketSize = 16;
constexpr std::uint16_t kRequester = 0;

const stability::MeshScene& mesh() {
  static const stability::MeshScene scene(stability::soup(60, 0.2F, 7));
  return scene;
}

const TracedScene& traced() {
  static const MemoryMap memory(MemoryCounts{.nodes = mesh().tree.nodes.size(),
                                             .leaf_entries = mesh().tree.leaf_triangles.size(),
                                             .triangles = mesh().records.size(),
                                             .vertices = 1,
                                             .materials = 1,
                                             .textures = {},
                                             .pixels = 1,
                                             .bytes_per_pixel = 16});
  static const TracedScene scene{mesh().tree, mesh().records, memory, TraversalScheme::kMasked};
  return scene;
}

template <typename M>
struct TraversalBench {
  explicit TraversalBench(std::uint64_t seed)
      : bench(seed),
        spec(random_unit(bench.random)),
        cache(random_cache(bench.random)),
        num_free(spec.contexts) {
    in_packets = &bench.template to_unit<RayPacket*>("packets",
                                                     {.capacity = kUnbounded, .latency = kLatency});
    in_done = &bench.template to_unit<LeafDone>(
        "done", {.capacity = kUnbounded, .latency = kLatency, .interval = 0});
    out_free = &bench.template from_unit<ContextFree>(
        "free", {.capacity = kUnbounded, .latency = kLatency, .interval = 0});
    for (const char* name : {"0", "1"}) {
      jobs.push_back(&bench.template from_unit<LeafJob>(std::string("jobs") + name,
                                                        {.capacity = 2, .latency = kLatency}));
      out.push_back(&bench.template from_unit<RayPacket*>(std::string("out") + name,
                                                          {.capacity = 2, .latency = kLatency}));
    }
    build();
    bench.act = [this](Cycles now) { act(now); };
  }

  void build() {
    if constexpr (M::kTimed) {
      const AnswerTimes times{2 * kMemoryLatency, 2 * kLatency, 0};
      unit = std::make_unique<Unit>("unit", spec, kPacketSize, cache, traced(), times, &heat,
                                    *bench.domain, 0, lines.requests, kRequester);
      unit->in_packets(*in_packets);
      unit->in_done(*in_done);
      unit->in_lines(lines.responses);
      for (auto* link : jobs) unit->out_jobs(*link);
      for (auto* link : out) unit->out_packets(*link);
      unit->out_free(*out_free);
    } else {
      unit = std::make_unique<Unit>(
          "unit", spec, kPacketSize, traced(), heat, 0,
          clocked::Cache(cache, kRequester, lines.requests, lines.responses));
      unit->in_packets = in_packets;
      unit->in_done = in_done;
      unit->out_free = out_free;
      for (auto* link : jobs) unit->out_jobs.add(*link);
      for (auto* link : out) unit->out_packets.add(*link);
    }
  }

  void act(Cycles now) {
    lines.act(now);
    while (out_free->has_arrived(now)) num_free += out_free->read(now).unit == 0 ? 1 : 0;
    if (num_free != 0 && now < kLastAction / 4 && bench.random.below(3) == 0) {
      packets.push_back(
          std::make_unique<RayPacket>(stability::random_packet(bench.random, kPacketSize, mesh())));
      if (packets.back()->active == 0) return;
      UnitBench<M>::template write<RayPacket*>(*in_packets, packets.back().get(), now);
      --num_free;
    }
    for (auto* link : jobs) {
      if (!link->has_arrived(now) || bench.random.below(2) == 0) continue;
      const LeafJob job = link->read(now);
      bench.note("job", now, job.leaf, job.num_tests, job.context);
      awaiting.push_back(job.context);
    }
    if (!awaiting.empty() && bench.random.below(3) != 0) {
      UnitBench<M>::template write<LeafDone>(*in_done, {awaiting.front()}, now);
      awaiting.pop_front();
    }
    for (auto* link : out) {
      const bool takes = now > kLastAction / 2 || bench.random.below(6) == 0;
      if (!link->has_arrived(now) || !takes) continue;
      bench.note("packet", now, link->read(now)->active);
    }
  }

  void run_to_end() {
    bench.run_unit(*unit);
    EXPECT_FALSE(unit->cache().has_pending());
    bench.note_counters(unit->pipeline_stats());
    bench.note_counters(unit->cache().stats());
    bench.note_counters(unit->primary_counts());
    bench.note_counters(unit->secondary_counts());
    bench.note_stalls(*unit);
  }

  using Unit = std::conditional_t<M::kTimed, TraversalUnit, clocked::TraversalUnit>;
  template <typename T>
  using Link = typename M::template Link<T>;
  UnitBench<M> bench;
  UnitSpec spec;
  CacheSpec cache;
  HeatMaps heat;
  CacheLinks<M> lines{bench, kRequester};
  std::vector<std::unique_ptr<RayPacket>> packets;
  std::size_t num_free;
  std::deque<std::uint16_t> awaiting;
  Link<RayPacket*>* in_packets = nullptr;
  Link<LeafDone>* in_done = nullptr;
  Link<ContextFree>* out_free = nullptr;
  std::vector<Link<LeafJob>*> jobs;
  std::vector<Link<RayPacket*>*> out;
  std::unique_ptr<Unit> unit;
};

template <typename M>
struct IntersectionBench {
  explicit IntersectionBench(std::uint64_t seed)
      : bench(seed), spec(random_unit(bench.random)), cache(random_cache(bench.random)) {
    for (const char* name : {"0", "1", "2"}) {
      jobs.push_back(&bench.template to_unit<LeafJob>(std::string("jobs") + name,
                                                      {.capacity = 3, .latency = kLatency}));
      done.push_back(&bench.template from_unit<LeafDone>(
          std::string("done") + name,
          {.capacity = kUnbounded, .latency = kLatency, .interval = 0}));
    }
    for (std::uint32_t node = 0; node < mesh().tree.nodes.size(); ++node) {
      if (mesh().tree.nodes[node].is_leaf() && mesh().tree.nodes[node].count() != 0) {
        leaves.push_back(node);
      }
    }
    if constexpr (M::kTimed) {
      const AnswerTimes times{2 * kMemoryLatency, 2 * kLatency, 0};
      unit = std::make_unique<Unit>("unit", spec, kPacketSize, cache, traced(), times,
                                    *bench.domain, lines.requests, kRequester);
      unit->in_lines(lines.responses);
      for (auto* link : jobs) unit->in_jobs(*link);
      for (auto* link : done) unit->out_done(*link);
    } else {
      unit = std::make_unique<Unit>(
          "unit", spec, kPacketSize, traced(),
          clocked::Cache(cache, kRequester, lines.requests, lines.responses));
      for (auto* link : jobs) unit->in_jobs.add(*link);
      unit->out_done = done;
    }
    bench.act = [this](Cycles now) { act(now); };
  }

  void act(Cycles now) {
    lines.act(now);
    const auto number = static_cast<std::uint16_t>(bench.random.below(jobs.size()));
    const std::uint32_t leaf = leaves[bench.random.below(leaves.size())];
    const std::uint32_t tests =
        1 + static_cast<std::uint32_t>(bench.random.below(mesh().tree.nodes[leaf].count()));
    if (sent < 200 && bench.random.below(2) == 0) {
      const LeafJob job{leaf, tests, number, static_cast<std::uint16_t>(sent % 64)};
      sent += UnitBench<M>::template write<LeafJob>(*jobs[number], job, now) ? 1 : 0;
    }
    for (auto* link : done) {
      while (link->has_arrived(now)) bench.note("done", now, link->read(now).context);
    }
  }

  void run_to_end() {
    bench.run_unit(*unit);
    EXPECT_FALSE(unit->cache().has_pending());
    bench.note("jobs", sent);
    bench.note_counters(unit->pipeline_stats());
    bench.note_counters(unit->cache().stats());
    bench.note_stalls(*unit);
  }

  using Unit = std::conditional_t<M::kTimed, IntersectionUnit, clocked::IntersectionUnit>;
  UnitBench<M> bench;
  UnitSpec spec;
  CacheSpec cache;
  CacheLinks<M> lines{bench, kRequester};
  std::vector<std::uint32_t> leaves;
  std::uint64_t sent = 0;
  std::vector<typename M::template Link<LeafJob>*> jobs;
  std::vector<typename M::template Link<LeafDone>*> done;
  std::unique_ptr<Unit> unit;
};

class TracingUnits : public BothModels {};

TEST_P(TracingUnits, TraversalUnitIsTheSame) {
  expect_both_alike<TraversalBench>(GetParam());
}
TEST_P(TracingUnits, IntersectionUnitIsTheSame) {
  expect_both_alike<IntersectionBench>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Seeds, TracingUnits, testing::Range<std::uint64_t>(0, 12));

}  // namespace
}  // namespace sheaf::test
