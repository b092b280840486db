// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/report_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "kdtree/kd_stats.h"
#include "memory/dram/channel_stats.h"
#include "memory/l2_cache.h"
#include "memory/main_memory.h"
#include "system/coherence.h"
#include "units/film_unit.h"
#include "units/packet_arbiter.h"
#include "units/primary_source.h"
#include "units/spawn_router.h"
#include "units/traversal_unit.h"

namespace sheaf {
namespace {

void report_trace(const std::string& path, const TraceCounts& counts, StatsTree& stats) {
  stats.add_counters(path, counts);
  stats.add_ratio(path + ".p_t", counts.lane_inner_visits, counts.packet_inner_visits, "1",
                  "Inner nodes visited by the rays, each traced alone, per node visit of a packet");
  stats.add_ratio(path + ".p_i", counts.lane_triangle_tests, counts.packet_triangle_tests, "1",
                  "Triangle tests of the rays, each traced alone, per test of a packet");
}

constexpr std::array<std::string_view, kNumRayKinds> kKindNames{"primary", "reflection",
                                                                "refraction", "shadow"};

}  // namespace

void report_sorter(const RaySorter& sorter, const std::string& path, StatsTree& stats) {
  const RayCacheStats& counters = sorter.stats();
  stats.add_counters(path, counters);
  stats.add_ratio(path + ".hit_rate", counters.num_hits, counters.num_insertions, "1",
                  "Rays that met an open cell, per ray");
  const std::uint64_t packets = counters.num_packets();
  stats.add_ratio(path + ".mean_cell_residence", counters.sum_cell_residence, packets, "cycles",
                  "Mean time from a cell's opening to its departure");
  add_histogram(stats, path + ".fill", sorter.fill(), "packets", "rays",
                "Rays in a packet that left the ray cache");
}

void report_shading_sorter(const ShadingSorter& sorter, const std::string& path, StatsTree& stats) {
  const ShaderCacheStats& counters = sorter.stats();
  stats.add_counters(path, counters);
  stats.add_ratio(path + ".hit_rate", counters.num_hits, counters.num_insertions, "1",
                  "Rays that met an open cell, per ray");
  stats.add_ratio(path + ".rays_per_material_in", counters.num_insertions,
                  counters.sum_materials_in, "rays",
                  "Rays to be shaded per material of a packet, before sorting");
  stats.add_ratio(path + ".rays_per_material_out", counters.num_insertions,
                  counters.sum_materials_out, "rays",
                  "Rays to be shaded per material of a packet, after sorting");
}

void report_traces(const TraceCounts& primary, const TraceCounts& secondary, bool has_secondary,
                   StatsTree& stats) {
  report_trace("trace.primary", primary, stats);
  if (has_secondary) report_trace("trace.secondary", secondary, stats);
}

void report_rays(const RayCounts& rays, StatsTree& stats) {
  const RayCounts::Entry total = rays.total();
  stats.add("rays.num_spawned", total.spawned, "rays", "Rays of all kinds and depths");
  stats.add("rays.num_retired", total.retired, "rays", "Rays traced and shaded");
  stats.add("rays.num_hits", total.hits, "rays", "Rays that hit something");
  for (std::size_t depth = 0; depth < rays.by_depth().size(); ++depth) {
    for (std::size_t kind = 0; kind < kNumRayKinds; ++kind) {
      const RayCounts::Entry& entry = rays.by_depth()[depth][kind];
      if (entry.spawned == 0) continue;
      const std::string path = fmt::format("rays.{}.depth{}", kKindNames[kind], depth);
      stats.add(path + ".num_spawned", entry.spawned, "rays", "Rays of this kind and depth");
      stats.add(path + ".num_retired", entry.retired, "rays", "Of these, traced and shaded");
      stats.add(path + ".num_hits", entry.hits, "rays", "Of these, hit something");
    }
  }
}

void report_scene(const PreparedScene& scene, const BuildPlan& plan, StatsTree& stats) {
  stats.add("scene.triangles", scene.scene.triangles.size(), "triangles",
            "Triangles after instancing");
  stats.add("scene.vertices", scene.scene.positions.size(), "vertices", "Vertices");
  stats.add("scene.materials", scene.scene.materials.size(), "materials", "Materials in use");
  stats.add("scene.lights", scene.scene.lights.size(), "lights", "Lights");
  const KdStats tree = measure_kd_tree(scene.tree, 1.0, 1.0);
  stats.add("kdtree.nodes", tree.num_nodes, "nodes", "Nodes of the kd-tree");
  stats.add("kdtree.leaves", tree.num_leaves, "leaves", "Leaves of the kd-tree");
  stats.add("kdtree.references", tree.num_references, "triangles", "Entries in all leaf lists");
  stats.add("kdtree.depth", static_cast<std::uint64_t>(tree.depth), "nodes", "Longest path");
  stats.add("memory.footprint", scene.memory.total_size(), "bytes",
            "Simulated memory that tree, triangles, attributes, textures and frame buffer take");
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
      CounterGroup{"system.primary_source", "Camera rays", PrimarySourceStats::infos()},
      CounterGroup{"system.packet_arbiter", "Choice of the next packet", ArbiterStats::infos()},
      CounterGroup{"system.ray_cache", "Left out for the heuristic none", RayCacheStats::infos()},
      CounterGroup{"system.spawn_router", "Only for the heuristic none", SpawnRouterStats::infos()},
      CounterGroup{"system.shader_cache", "Only with shader_cache.cells",
                   ShaderCacheStats::infos()},
      CounterGroup{"system.<unit><n>", "Traversal, intersection and shader units",
                   PipelineStats::infos()},
      CounterGroup{"system.<unit>", "Every unit: what each cycle went to", kStallInfos},
      CounterGroup{"trace.primary, trace.secondary", "Work of the packets", TraceCounts::infos()},
      CounterGroup{"coherence.primary, coherence.secondary",
                   "Only with measure.coherence: one untimed pass of single rays",
                   CoherenceCounts::infos()},
      CounterGroup{"system.film", "Frame buffer", FilmStats::infos()},
      CounterGroup{"system.<unit><n>.<cache>", "Private caches", CacheStats::infos()},
      CounterGroup{"system.<unit><n>.<cache>.<kind of data>", "The same by kind of data",
                   CacheKindStats::infos()},
      CounterGroup{"system.l2", "Shared second-level cache", L2Stats::infos()},
      CounterGroup{"system.l2.<kind of data>", "The same by kind of data", L2KindStats::infos()},
      CounterGroup{"system.dram", "Memory behind the TLM socket", DramStats::infos()},
      CounterGroup{"system.dram.channels", "Only with banks (dram.model): all channels together",
                   DramChannelStats::infos()},
  };
  return kGroups;
}

}  // namespace sheaf
