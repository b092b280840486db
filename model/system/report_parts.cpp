// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/report_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "memory/dram/channel_stats.h"
#include "memory/dram/dram_report.h"
#include "memory/l2_cache.h"
#include "memory/main_memory.h"
#include "system/coherence.h"
#include "system/estimate_report.h"
#include "system/reported_values.h"
#include "units/film_unit.h"
#include "units/packet_arbiter.h"
#include "units/primary_source.h"
#include "units/spawn_router.h"
#include "units/spill_unit.h"
#include "units/traversal_unit.h"

namespace sheaf {
namespace {

void report_trace(const std::string& path, const TraceCounts& counts, StatsTree& stats) {
  stats.add_counters(path, counts);
  stats.add_ratio(path, TraceValues::p_t, counts.lane_inner_visits, counts.packet_inner_visits);
  stats.add_ratio(path, TraceValues::p_i, counts.lane_triangle_tests, counts.packet_triangle_tests);
}

constexpr std::array<std::string_view, kNumRayKinds> kKindNames{"primary", "reflection",
                                                                "refraction", "shadow"};

}  // namespace

void report_sorter(const RaySorter& sorter, const std::string& path, StatsTree& stats) {
  const RayCacheStats& counters = sorter.stats();
  stats.add_counters(path, counters);
  stats.add_ratio(path, SorterValues::hit_rate, counters.num_hits, counters.num_insertions);
  const std::uint64_t packets = counters.num_packets();
  stats.add_ratio(path, SorterValues::mean_cell_residence, counters.sum_cell_residence, packets);
  add_histogram(stats, path + ".fill", sorter.fill(), "packets", "rays",
                "Rays in a packet that left the ray cache");
}

void report_shading_sorter(const ShadingSorter& sorter, const std::string& path, StatsTree& stats) {
  const ShaderCacheStats& counters = sorter.stats();
  stats.add_counters(path, counters);
  stats.add_ratio(path, ShadingSorterValues::hit_rate, counters.num_hits, counters.num_insertions);
  stats.add_ratio(path, ShadingSorterValues::rays_per_material_in, counters.num_insertions,
                  counters.sum_materials_in);
  stats.add_ratio(path, ShadingSorterValues::rays_per_material_out, counters.num_insertions,
                  counters.sum_materials_out);
}

void report_traces(const TraceCounts& primary, const TraceCounts& secondary, bool has_secondary,
                   StatsTree& stats) {
  report_trace("trace.primary", primary, stats);
  if (has_secondary) report_trace("trace.secondary", secondary, stats);
}

void report_rays(const RayCounts& rays, StatsTree& stats) {
  const RayCounts::Entry total = rays.total();
  stats.add("rays", RayValues::num_spawned, total.spawned);
  stats.add("rays", RayValues::num_retired, total.retired);
  stats.add("rays", RayValues::num_hits, total.hits);
  for (std::size_t depth = 0; depth < rays.by_depth().size(); ++depth) {
    for (std::size_t kind = 0; kind < kNumRayKinds; ++kind) {
      const RayCounts::Entry& entry = rays.by_depth()[depth][kind];
      if (entry.spawned == 0) continue;
      const std::string path = fmt::format("rays.{}.depth{}", kKindNames[kind], depth);
      stats.add(path, RayValues::num_spawned, entry.spawned);
      stats.add(path, RayValues::num_retired, entry.retired);
      stats.add(path, RayValues::num_hits, entry.hits);
    }
  }
}

void report_scene(const PreparedScene& scene, const BuildPlan& plan, StatsTree& stats) {
  stats.add("scene", SceneValues::triangles, scene.scene.triangles.size());
  stats.add("scene", SceneValues::vertices, scene.scene.positions.size());
  stats.add("scene", SceneValues::materials, scene.scene.materials.size());
  stats.add("scene", SceneValues::lights, scene.scene.lights.size());
  stats.add("kdtree", KdTreeValues::nodes, scene.tree.nodes.size());
  stats.add("kdtree", KdTreeValues::leaves, scene.tree.num_leaves());
  stats.add("kdtree", KdTreeValues::references, scene.tree.leaf_triangles.size());
  stats.add("kdtree", KdTreeValues::depth, static_cast<std::uint64_t>(scene.tree.depth));
  stats.add("memory", MemoryValues::footprint, scene.memory.total_size());
  for (const auto& [what, why] : plan.left_out) {
    std::string name = what;
    std::replace_if(
        name.begin(), name.end(),
        [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    stats.add_text("left_out." + name, why, "Not built");
  }
}

std::span<const CounterGroup> counter_groups() {
  static const std::array kGroups{
      CounterGroup{"run", "What was run", RunValues::infos()},
      CounterGroup{"replay", "Only of a replayed memory trace", ReplayValues::infos()},
      CounterGroup{"scene", "What the scene holds", SceneValues::infos()},
      CounterGroup{"kdtree", "Its kd-tree", KdTreeValues::infos()},
      CounterGroup{"memory", "Simulated memory", MemoryValues::infos()},
      CounterGroup{"left_out.<part>", "Why this part was not built", {}},
      CounterGroup{"rays", "All rays", RayValues::infos()},
      CounterGroup{"rays.<kind>.depth<n>", "Rays of a kind and depth", RayValues::infos()},
      CounterGroup{"system", "The machine as a whole", SystemValues::infos()},
      CounterGroup{"system", "Only if run.fidelity is sampled", FrameEstimateValues::infos()},
      CounterGroup{"sample", "The same: the sample", SampleValues::infos()},
      CounterGroup{"estimate.<quantity>",
                   "Only if run.fidelity is sampled, or, without an "
                   "interval, analytic",
                   EstimateValues::infos()},
      CounterGroup{"bound",
                   "Only if run.fidelity is analytic: cycles that the frame would take if "
                   "this alone counted",
                   BoundCycles::infos()},
      CounterGroup{"system.link.<link>, system.packet_fifo", "Links between units",
                   LinkValues::infos()},
      CounterGroup{"system.primary_source", "Camera rays", PrimarySourceStats::infos()},
      CounterGroup{"system.packet_arbiter", "Choice of the next packet", ArbiterStats::infos()},
      CounterGroup{"system.ray_cache", "Left out for the heuristic none", RayCacheStats::infos()},
      CounterGroup{"system.ray_cache", "Formulas of these", SorterValues::infos()},
      CounterGroup{"system.ray_cache.fill", "Rays in a packet that left the ray cache",
                   kHistogramInfos},
      CounterGroup{"system.spawn_router", "Only for the heuristic none", SpawnRouterStats::infos()},
      CounterGroup{"system.spill", "Only with flow.control = spill", SpillStats::infos()},
      CounterGroup{"system.spill", "Formulas of these", SpillValues::infos()},
      CounterGroup{"system.shader_cache", "Only with shader_cache.cells",
                   ShaderCacheStats::infos()},
      CounterGroup{"system.shader_cache", "Formulas of these", ShadingSorterValues::infos()},
      CounterGroup{"system.<unit><n>", "Traversal, intersection and shader units",
                   PipelineStats::infos()},
      CounterGroup{"system.<unit>", "Every unit: what each cycle went to", kStallInfos},
      CounterGroup{"trace.primary, trace.secondary", "Work of the packets", TraceCounts::infos()},
      CounterGroup{"trace.primary, trace.secondary", "Formulas of these", TraceValues::infos()},
      CounterGroup{"coherence.primary, coherence.secondary",
                   "Only with measure.coherence: one untimed pass of single rays",
                   CoherenceCounts::infos()},
      CounterGroup{"coherence.primary, coherence.secondary", "Formulas of these",
                   CoherenceValues::infos()},
      CounterGroup{"system.film", "Frame buffer", FilmStats::infos()},
      CounterGroup{"system.<unit><n>.<cache>, system.film.cache", "Private caches",
                   CacheStats::infos()},
      CounterGroup{"system.<unit><n>.<cache>, system.film.cache, system.l2", "Formulas of these",
                   CacheValues::infos()},
      CounterGroup{"system.<unit><n>.<cache>.<kind of data>, system.film.cache.<kind of data>",
                   "The same by kind of data", CacheKindStats::infos()},
      CounterGroup{"system.crossbar.requests", "Only with crossbar.request_width",
                   RequestCrossbarStats::infos()},
      CounterGroup{"system.crossbar.responses", "Only with crossbar.response_width",
                   ResponseCrossbarStats::infos()},
      CounterGroup{"system.l2", "Shared second-level cache", L2Stats::infos()},
      CounterGroup{"system.l2.<kind of data>", "The same by kind of data", L2KindStats::infos()},
      CounterGroup{"system.dram", "Memory behind the TLM socket", DramStats::infos()},
      CounterGroup{"system.dram", "Formulas of these", MainMemoryValues::infos()},
      CounterGroup{"system.dram", "Memory with banks only", BankedMemoryValues::infos()},
      CounterGroup{"system.dram.channels", "The same: all channels", DramChannelStats::infos()},
      CounterGroup{"system.dram.energy", "The same: energy, none where no source gives it",
                   DramEnergyValues::infos()},
  };
  return kGroups;
}

}  // namespace sheaf
