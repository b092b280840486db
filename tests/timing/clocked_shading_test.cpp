// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Shader unit, shader cache and film of both models, side by side.

#include "kdtree/memory_map.h"
#include "timing/both_models.h"
#include "timing/random_specs.h"
#include "units/clocked/film.h"
#include "units/clocked/shader_cache.h"
#include "units/clocked/shader_unit.h"
#include "units/film_unit.h"
#include "units/shader_cache_unit.h"
#include "units/shader_unit.h"

namespace sheaf::test {
namespace {

constexpr Cycles kLatency = 4;
constexpr int kPacketSize = 16;
constexpr std::uint32_t kNumTriangles = 60;
constexpr std::uint32_t kNumMaterials = 5;
constexpr std::uint32_t kNumPixels = 256;
constexpr std::uint32_t kTextureSide = 64;

Scene make_scene() {
  Scene scene;
  for (std::uint32_t i = 0; i < kNumTriangles; ++i) {
    scene.triangles.push_back({i, i + 1, i + 2});
    scene.triangle_material.push_back(static_cast<std::uint16_t>(i % kNumMaterials));
  }
  scene.materials.resize(kNumMaterials);
  return scene;
}

MemoryMap make_memory() {
  return MemoryMap(MemoryCounts{.nodes = 1,
                                .leaf_entries = 1,
                                .triangles = kNumTriangles,
                                .vertices = kNumTriangles + 2,
                                .materials = kNumMaterials,
                                .textures = {{kTextureSide, kTextureSide}},
                                .pixels = kNumPixels,
                                .bytes_per_pixel = 16});
}

/// Makes up what comes of a packet, from nothing but the packet.
class MadeUpShading final : public ShadingSource {
 public:
  void shade(const RayPacket& packet, PacketShading& out) override {
    out.clear();
    Random random(packet.tag[0].id);
    const auto upto = [&](std::uint64_t most) {
      return static_cast<std::uint32_t>(random.below(most + 1));
    };
    for (std::uint32_t i = upto(6); i != 0; --i) {
      out.triangles.push_back(upto(kNumTriangles - 1));
      if (upto(1) == 0) out.texels.push_back({0, upto(kTextureSide - 1), upto(kTextureSide - 1)});
    }
    for (std::uint32_t i = upto(3); i != 0; --i) {
      out.contributions.push_back({upto(kNumPixels - 1), Vec3(1.0F)});
    }
    out.spawned.begin_group();
    for (std::uint32_t i = upto(4); i != 0; --i) {
      Ray ray;
      ray.tag.kind = RayKind::kShadow;
      ray.tag.depth = 1;
      out.spawned.add(ray, static_cast<int>(i));
    }
  }
};

/// A packet of some rays that hit something, all of the made-up scene.
RayPacket* make_packet(PacketPool& pool, Random& random) {
  RayPacket* packet = pool.acquire();
  const std::uint64_t rays = 1 + random.below(kPacketSize);
  for (std::uint64_t i = 0; i < rays; ++i) {
    Ray ray;
    ray.tag.id = random.next();
    ray.tag.kind = random.below(4) == 0 ? RayKind::kShadow : RayKind::kPrimary;
    packet->put(static_cast<int>(i), ray);
    const auto triangle = static_cast<std::uint32_t>(random.below(kNumTriangles + 10));
    packet->hit_triangle[i] = triangle < kNumTriangles ? triangle : kNoHit;
  }
  return packet;
}

std::uint64_t num_rays(const RayPacket& packet) {
  return static_cast<std::uint64_t>(std::popcount(packet.active));
}

template <typename M>
struct ShaderBench {
  explicit ShaderBench(std::uint64_t seed)
      : bench(seed),
        spec(random_unit(bench.random)),
        attributes(random_cache(bench.random)),
        textures(random_cache(bench.random)) {
    for (const char* name : {"in0", "in1"}) {
      in.push_back(&bench.template to_unit<RayPacket*>(name, {.capacity = 2, .latency = kLatency}));
    }
    film = &bench.template from_unit<FilmBatch*>("film", {.capacity = 2, .latency = kLatency});
    const std::size_t capacity = seed % 2 == 0 ? clocked::Link<int>::kUnbounded : 2;
    spawned = &bench.template from_unit<SpawnBundle*>("bundles",
                                                      {.capacity = capacity, .latency = kLatency});
    if constexpr (M::kTimed) {
      unit = std::make_unique<Unit>("unit", spec, kPacketSize, attributes, &textures, shaded,
                                    *bench.domain, attribute_lines.requests, 0, 1);
      unit->in_attribute_lines(attribute_lines.responses);
      unit->in_texture_lines(texture_lines.responses);
      for (auto* link : in) unit->in_packets(*link);
      unit->out_film(*film);
      unit->out_bundles(*spawned);
    } else {
      unit = std::make_unique<Unit>(
          "unit", spec, kPacketSize, shaded,
          clocked::Cache(attributes, 0, attribute_lines.requests, attribute_lines.responses),
          clocked::Cache(textures, 1, texture_lines.requests, texture_lines.responses));
      for (auto* link : in) unit->in_packets.add(*link);
      unit->out_film = film;
      unit->out_bundles = spawned;
    }
    bench.act = [this](Cycles now) { act(now); };
  }

  // The event-driven unit sends the requests of both caches over one link.
  void take_requests(Cycles now) {
    std::vector<LineRequest> requests;
    for (auto* lines : {&attribute_lines, &texture_lines}) {
      while (lines->requests.has_arrived(now)) requests.push_back(lines->requests.read(now));
    }
    for (const LineRequest& request : requests) attribute_lines.server.take(request, now);
    for (const LineRequest& request : requests) texture_lines.server.take(request, now);
  }

  void act(Cycles now) {
    take_requests(now);
    attribute_lines.server.answer(attribute_lines.responses, now);
    texture_lines.server.answer(texture_lines.responses, now);
    if (now < kLastAction / 2 && bench.random.below(3) == 0) {
      RayPacket* packet = make_packet(packets, bench.random);
      for (std::uint64_t i = 0; i < num_rays(*packet); ++i) rays.spawn(packet->tag[i]);
      flow.admit(num_rays(*packet), 0, now);
      auto& link = *in[bench.random.below(2)];
      if (!UnitBench<M>::template write<RayPacket*>(link, packet, now)) packets.release(packet);
    }
    if (film->has_arrived(now) && bench.random.below(8) == 0) {
      FilmBatch* batch = film->read(now);
      bench.note("batch", now, batch->size());
      batch->clear();
      batches.release(batch);
    }
    while (spawned->has_arrived(now)) {
      SpawnBundle* bundle = spawned->read(now);
      bench.note("bundle", now, bundle->rays.size());
      bundle->clear();
      bundles.release(bundle);
    }
  }

  void run_to_end() {
    bench.run_unit(*unit);
    bench.note_counters(unit->pipeline_stats());
    bench.note_counters(unit->attribute_cache().stats());
    bench.note_counters(unit->texture_cache()->stats());
    bench.note("live", flow.live(), flow.max_live(), packets.num_made());
    bench.note_stalls(*unit);
  }

  using Unit = std::conditional_t<M::kTimed, ShaderUnit, clocked::ShaderUnit>;
  template <typename T>
  using Link = typename M::template Link<T>;
  UnitBench<M> bench;
  UnitSpec spec;
  CacheSpec attributes, textures;
  Scene scene = make_scene();
  MemoryMap memory = make_memory();
  MadeUpShading shading;
  PacketPool packets{kPacketSize};
  ObjectPool<SpawnBundle> bundles;
  ObjectPool<FilmBatch> batches;
  RayCounts rays{1};
  FlowControl flow{FlowSpec{}, WorstCase(1, 1, 1), 0};
  ShadedScene shaded{scene, shading, memory, packets, bundles, batches, rays, flow};
  CacheLinks<M> attribute_lines{bench, 0};
  CacheLinks<M> texture_lines{bench, 1};
  std::vector<Link<RayPacket*>*> in;
  Link<FilmBatch*>* film = nullptr;
  Link<SpawnBundle*>* spawned = nullptr;
  std::unique_ptr<Unit> unit;
};

template <typename M>
struct FilmBench {
  explicit FilmBench(std::uint64_t seed) : bench(seed), cache(random_cache(bench.random)) {
    choose_writes(bench.random, cache.write);
    in = &bench.template to_unit<FilmBatch*>("in", {.capacity = 3, .latency = kLatency});
    if constexpr (M::kTimed) {
      unit = std::make_unique<Unit>("film", cache, *film, memory, batches, flow, *bench.domain,
                                    lines.requests, 0);
      unit->in_batches(*in);
      unit->in_lines(lines.responses);
    } else {
      unit = std::make_unique<Unit>("film", *film, memory, batches, flow,
                                    clocked::Cache(cache, 0, lines.requests, lines.responses));
      unit->in_batches = in;
    }
    flow.admit(1, 0, 0);
    bench.act = [this](Cycles now) { act(now); };
  }

  void act(Cycles now) {
    lines.act(now);
    if (now < kLastAction / 2 && bench.random.below(2) == 0) {
      FilmBatch* batch = batches.acquire();
      for (std::uint64_t i = 1 + bench.random.below(8); i != 0; --i) {
        const auto pixel = static_cast<std::uint32_t>(bench.random.below(kNumPixels));
        batch->push_back({pixel, Vec3(0.5F)});
      }
      if (!UnitBench<M>::template write<FilmBatch*>(*in, batch, now)) {
        batch->clear();
        batches.release(batch);
      }
    }
    if (now > kLastAction / 2 && flow.live() != 0 && bench.random.below(20) == 0) {
      flow.set_source(FlowControl::Source::kExhausted, now);
      flow.replace(1, 0, 0, 0, now);
    }
  }

  void run_to_end() {
    bench.run_unit(*unit);
    bench.note_counters(unit->stats());
    bench.note_counters(unit->cache().stats());
    bench.note_stalls(*unit);
  }

  using Unit = std::conditional_t<M::kTimed, FilmUnit, clocked::FilmUnit>;
  UnitBench<M> bench;
  CacheSpec cache;
  MemoryMap memory = make_memory();
  std::unique_ptr<Film> film = make_film(FilmFormat::kFloat, kNumPixels);
  ObjectPool<FilmBatch> batches;
  FlowControl flow{FlowSpec{}, WorstCase(1, 1, 1), 0};
  CacheLinks<M> lines{bench, 0};
  typename M::template Link<FilmBatch*>* in = nullptr;
  std::unique_ptr<Unit> unit;
};

template <typename M>
struct ShaderCacheBench {
  explicit ShaderCacheBench(std::uint64_t seed) : bench(seed) {
    spec.cells = 1 + static_cast<std::uint32_t>(bench.random.below(6));
    spec.rays_per_cycle = 1U << bench.random.below(4);
    for (const char* name : {"0", "1"}) {
      in.push_back(&bench.template to_unit<RayPacket*>(std::string("in") + name,
                                                       {.capacity = 3, .latency = kLatency}));
      out.push_back(&bench.template from_unit<RayPacket*>(std::string("out") + name,
                                                          {.capacity = 2, .latency = kLatency}));
    }
    if constexpr (M::kTimed) {
      unit = std::make_unique<Unit>("unit", spec, scene, packets, flow, *bench.domain);
      for (auto* link : in) unit->in_packets(*link);
      for (auto* link : out) unit->out_packets(*link);
    } else {
      unit = std::make_unique<Unit>("unit", spec, scene, packets, flow);
      for (auto* link : in) unit->in_packets.add(*link);
      for (auto* link : out) unit->out_packets.add(*link);
    }
    bench.act = [this](Cycles now) { act(now); };
  }

  void act(Cycles now) {
    using Source = FlowControl::Source;
    const bool last = now > kLastAction / 2;
    if (!last && bench.random.below(3) == 0) {
      RayPacket* packet = make_packet(packets, bench.random);
      const std::uint64_t rays = num_rays(*packet);
      auto& link = *in[bench.random.below(2)];
      if (UnitBench<M>::template write<RayPacket*>(link, packet, now)) {
        flow.admit(rays, 0, now);
      } else {
        packets.release(packet);
      }
    }
    flow.set_source(last || bench.random.below(2) == 0 ? Source::kTileIssued : Source::kIssuing,
                    now);
    for (auto* link : out) {
      if (!link->has_arrived(now) || (!last && bench.random.below(4) != 0)) continue;
      RayPacket* packet = link->read(now);
      bench.note("packet", now, num_rays(*packet), packet->tag[0].id);
      flow.replace(num_rays(*packet), 0, 0, 0, now);
      packets.release(packet);
    }
  }

  void run_to_end() {
    bench.run_unit(*unit);
    EXPECT_EQ(flow.live(), 0U);
    bench.note_counters(unit->sorter().stats());
    bench.note_stalls(*unit);
  }

  using Unit = std::conditional_t<M::kTimed, ShaderCacheUnit, clocked::ShaderCache>;
  template <typename T>
  using Link = typename M::template Link<T>;
  UnitBench<M> bench;
  ShaderCacheSpec spec;
  Scene scene = make_scene();
  PacketPool packets{kPacketSize};
  FlowControl flow{FlowSpec{}, WorstCase(1, 1, 1), 0};
  std::vector<Link<RayPacket*>*> in, out;
  std::unique_ptr<Unit> unit;
};

class ShadingUnits : public BothModels {};

TEST_P(ShadingUnits, ShaderUnitIsTheSame) {
  expect_both_alike<ShaderBench>(GetParam());
}
TEST_P(ShadingUnits, FilmIsTheSame) {
  expect_both_alike<FilmBench>(GetParam());
}
TEST_P(ShadingUnits, ShaderCacheIsTheSame) {
  expect_both_alike<ShaderCacheBench>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Seeds, ShadingUnits, testing::Range<std::uint64_t>(0, 12));

}  // namespace
}  // namespace sheaf::test
