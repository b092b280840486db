// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/energy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "energy/counts.h"
#include "energy/operations.h"
#include "energy/sram_list.h"
#include "kdtree/memory_map.h"
#include "memory/dram/energy.h"

namespace sheaf {
namespace {

/// What one item of a run comes to. What was not built costs nothing and is not reported.
struct Energy {
  bool built = true;
  Count picojoule;
};
constexpr Energy kNotBuilt{.built = false, .picojoule = {}};
constexpr Energy kUnknown{.built = true, .picojoule = {}};

Energy times(const Count& count, double picojoule) {
  return {.built = true, .picojoule = count * picojoule};
}

constexpr double kWordBits = 64;
double words(double bits) {
  return std::ceil(bits / kWordBits);
}

/// A run and the machine that it ran on.
struct Run {
  Run(const Config& c, const BuildPlan& p, const StatsTree& stats)
      : config(c),
        plan(p),
        counts(stats),
        sizes(machine_sizes(c, p, stats)),
        srams(list_srams(c, p, sizes)) {}

  const Config& config;
  const BuildPlan& plan;
  const Counts counts;
  const MachineSizes sizes;
  const std::vector<Sram> srams;

  [[nodiscard]] bool is_interval() const {
    return config.traversal_scheme == Scheme::kInterval ||
           config.traversal_scheme == Scheme::kIntervalEntry;
  }
  /// Lanes that work at a step or test. Under single and masked those with a ray to be traced
  /// there; the others' masks are not counted, so all: an upper bound.
  [[nodiscard]] Count lanes(const char* lane_counter, const char* packet_counter) const {
    const bool exact =
        config.traversal_scheme == Scheme::kSingle || config.traversal_scheme == Scheme::kMasked;
    return exact ? counts.traced(lane_counter)
                 : counts.traced(packet_counter) * static_cast<double>(config.packet.size);
  }
  [[nodiscard]] Count lane_tests() const {
    return lanes("lane_triangle_tests", "packet_triangle_tests");
  }
  [[nodiscard]] Count spawned() const {
    return counts.of("rays.num_spawned") + counts.rays("primary", "num_spawned") * -1;
  }
  [[nodiscard]] double ray_words() const { return words(static_cast<double>(sizes.ray_bits)); }
  [[nodiscard]] double ray_and_hit_words() const {
    return words(static_cast<double>(sizes.ray_bits + sizes.hit_bits));
  }

  /// So many 64-bit words read from or written to a memory.
  [[nodiscard]] Energy access(std::string_view memory, const Count& num_words) const {
    const auto sram = std::ranges::find(srams, memory, &Sram::name);
    if (sram == srams.end()) return kNotBuilt;
    const std::optional<double> each = sram->word_picojoule();
    return each ? times(num_words, *each) : kUnknown;
  }
  /// A private cache: every look-up reads `look_up` bytes, a fill writes a line, a write-back reads
  /// one.
  [[nodiscard]] Energy cache(std::string_view memory, const Count& accesses, double look_up,
                             const Count& filled, const Count& written) const {
    return access(memory, accesses * words(8 * look_up) + (filled + written) * (1.0 / 8));
  }
  [[nodiscard]] Energy cache_of(const char* unit, const std::string& name, double look_up) const {
    const auto counter = [&](const char* what) { return counts.all(unit, name + '.' + what); };
    return cache(name, counter("num_accesses"), look_up, counter("bytes_read"),
                 counter("bytes_written"));
  }
};

Energy camera_rays(const Run& r) {
  return times(r.counts.rays("primary", "num_spawned"), kCameraRay.picojoule());
}

Energy set_up(const Run& r) {
  return times(r.counts.of("rays.num_retired"), kRaySetUp.picojoule());
}
Energy steps(const Run& r) {
  if (r.is_interval()) {
    return times(r.counts.traced("packet_inner_visits"), kIntervalStep.picojoule());
  }
  return times(r.lanes("lane_inner_visits", "packet_inner_visits"), kNodeStep.picojoule());
}
Energy clips(const Run& r) {
  if (!r.is_interval()) return kNotBuilt;
  return times(r.counts.traced("leaf_clips") * r.config.packet.size, kLeafClip.picojoule());
}
// Written once a ray; a step reads two origins, 1/d and the interval, and writes the interval.
Energy prepared_rays(const Run& r) {
  if (r.is_interval()) return kUnknown;
  const Count steps = r.lanes("lane_inner_visits", "packet_inner_visits");
  return r.access("prepared_rays",
                  r.counts.of("rays.num_retired") * words(384) + steps * words(160 + 64));
}
Energy node_cache(const Run& r) {
  return r.cache_of("traversal_unit", "node_cache", MemoryMap::kNodeSize);
}

Energy tests(const Run& r) {
  return times(r.lane_tests(), kTriangleTest.picojoule());
}
Energy sheared_rays(const Run& r) {
  return r.access("sheared_rays", (r.counts.of("rays.num_retired") + r.lane_tests()) * words(226));
}
// An entry of 32 bits is written and read for every test.
Energy leaf_lists(const Run& r) {
  return r.access("leaf_lists", r.counts.traced("packet_triangle_tests"));
}
Energy triangle_cache(const Run& r) {
  return r.cache_of("intersection_unit", "triangle_cache", MemoryMap::kTriangleSize);
}

Energy shading(const Run& r) {
  const Count hits = r.counts.of("rays.num_hits") + r.counts.rays("shadow", "num_hits") * -1;
  return {.built = true,
          .picojoule = hits * kSurface.picojoule() +
                       r.counts.rays("reflection", "num_spawned") * kReflection.picojoule() +
                       r.counts.rays("refraction", "num_spawned") * kRefraction.picojoule() +
                       r.counts.rays("shadow", "num_spawned") * kShadow.picojoule()};
}
Energy texture_filtering(const Run& r) {
  return r.plan.texture_cache ? kUnknown : kNotBuilt;
}
Energy fetched_attributes(const Run& r) {
  const Count hits = r.counts.of("rays.num_hits") + r.counts.rays("shadow", "num_hits") * -1;
  return r.access("fetched_attributes", hits * (2 * words(3 * 256 + 512)));
}
Energy spawned_bundles(const Run& r) {
  return r.access("spawned_bundles", r.spawned() * (2 * r.ray_words()));
}
Energy attribute_cache(const Run& r) {
  return r.cache_of("shader_unit", "attribute_cache",
                    static_cast<double>(r.config.attribute_cache.line));
}
Energy texture_cache(const Run& r) {
  return r.cache_of("shader_unit", "texture_cache",
                    static_cast<double>(r.config.texture_cache.line));
}

Energy shader_cache_cells(const Run& r) {
  return r.access("shader_cache",
                  r.counts.of("system.shader_cache.num_insertions") * (2 * r.ray_and_hit_words()));
}

Energy ray_cache_key(const Run& r) {
  if (!r.plan.ray_cache) return kNotBuilt;
  using Kind = HeuristicChoice::Kind;
  const Count rays = r.counts.of("system.ray_cache.num_insertions");
  const double cells =
      r.config.ray_cache.cells != 0 ? r.config.ray_cache.cells : r.plan.heuristic.natural_cells();
  switch (r.plan.heuristic.kind) {
    case Kind::kNone:
    case Kind::kDir:
      return times(rays, 0);  // bits of the ray, without arithmetic
    case Kind::kMdir:
      return times(rays, kFaceKey.picojoule());
    case Kind::kFastpos:
      return times(rays, kOctantKey.picojoule());
    case Kind::kPos:
      return times(rays, cells * kAnchorKey.picojoule());
    case Kind::kRay5d:
      return times(rays, kFaceKey.picojoule() + kVoxelKey.picojoule());
    case Kind::kGrid:
      return times(rays, kVoxelKey.picojoule());
    case Kind::kOpos:
      return kUnknown;
  }
  return kUnknown;
}
Energy ray_cache_cells(const Run& r) {
  return r.access("ray_cache",
                  r.counts.of("system.ray_cache.num_insertions") * (2 * r.ray_words()));
}
Energy spawned_rays(const Run& r) {
  return r.access("spawned_rays", r.spawned() * (2 * r.ray_words()));
}

// Source or ray cache writes a ray, traversal reads it and writes its hit, the shader reads both.
Energy packet_store(const Run& r) {
  const double each =
      2 * r.ray_words() + words(static_cast<double>(r.sizes.hit_bits)) + r.ray_and_hit_words();
  return r.access("packet_store", r.counts.of("rays.num_retired") * each);
}

Energy film_addition(const Run& r) {
  const Count additions = r.counts.of("system.film.num_contributions");
  switch (r.config.film.format) {
    case FilmFormat::kUnorm8:
      return times(additions,
                   3 * (Coefficients::fp32_multiply.value + Coefficients::int8_add.value));
    case FilmFormat::kHalf:
      return times(additions, 3 * Coefficients::fp16_add.value);
    case FilmFormat::kFloat:
      return times(additions, 3 * Coefficients::fp32_add.value);
    case FilmFormat::kExact:  // one word of 64 bits; carries further up are rare
      return times(additions, 3 * 2 * Coefficients::int32_add.value);
  }
  return kUnknown;
}
// Every access reads a pixel and writes it.
Energy film_cache(const Run& r) {
  constexpr std::array kBytes{4.0, 8.0, 16.0, 128.0};
  const double pixel = std::min(kBytes[static_cast<std::size_t>(r.config.film.format)],
                                static_cast<double>(r.config.film_cache.line));
  const auto counter = [&](const char* what) {
    return r.counts.of(std::string("system.film.cache.") + what);
  };
  return r.cache("film_cache", counter("num_accesses") * 2, pixel, counter("bytes_read"),
                 counter("bytes_written"));
}

// What is asked for is read, what comes from above or below is written, a victim is read.
Energy l2_array(const Run& r) {
  const auto counter = [&](const char* what) {
    return r.counts.of(std::string("system.l2.") + what);
  };
  const Count victims = counter("num_writebacks") * static_cast<double>(r.config.l2.line);
  const Count bytes =
      counter("bytes_requested") + counter("bytes_read") + counter("bytes_received") + victims;
  return r.access("l2", bytes * (1.0 / 8));
}

Energy unknown(const Run& /*r*/) {
  return kUnknown;
}
Energy fixed_dram(const Run& r) {
  return r.config.dram.model == DramModel::kFixed ? kUnknown : kNotBuilt;
}
template <const CounterInfo& kItem>
Energy banked_dram(const Run& r) {
  if (r.config.dram.model == DramModel::kFixed) return kNotBuilt;
  return {.built = true, .picojoule = r.counts.of("system.dram.energy." + std::string(kItem.name))};
}

struct Item {
  std::string_view unit;
  CounterInfo info;
  Energy (*of)(const Run&);
};

constexpr std::array kItems{
    Item{"primary_source", {"arithmetic", "pJ", "Directions of camera rays"}, camera_rays},
    Item{"traversal_unit", {"set_up", "pJ", "Rays prepared for tree and triangles"}, set_up},
    Item{"traversal_unit", {"steps", "pJ", "Distances and intervals at inner nodes"}, steps},
    Item{"traversal_unit", {"clips", "pJ", "Rays clipped to leaves; interval only"}, clips},
    Item{"traversal_unit", {"prepared_rays", "pJ", "SRAM of prepared rays"}, prepared_rays},
    Item{"traversal_unit", {"stack", "pJ", "SRAM of the stack; pushes are not counted"}, unknown},
    Item{"traversal_unit", {"node_cache", "pJ", "Look-ups and fills"}, node_cache},
    Item{"intersection_unit", {"tests", "pJ", "Tests up to the edge functions' signs"}, tests},
    Item{"intersection_unit",
         {"hits", "pJ", "Their divisions; candidates are not counted"},
         unknown},
    Item{"intersection_unit", {"sheared_rays", "pJ", "SRAM of prepared rays"}, sheared_rays},
    Item{"intersection_unit", {"leaf_lists", "pJ", "SRAM of leaves' lists"}, leaf_lists},
    Item{"intersection_unit", {"triangle_cache", "pJ", "Look-ups and fills"}, triangle_cache},
    Item{"shader_unit", {"arithmetic", "pJ", "Surfaces and spawned rays"}, shading},
    Item{"shader_unit",
         {"filtering", "pJ", "Texture filtering; it is not counted"},
         texture_filtering},
    Item{"shader_unit",
         {"fetched_attributes", "pJ", "SRAM of vertices and materials"},
         fetched_attributes},
    Item{
        "shader_unit", {"spawned_bundles", "pJ", "SRAM of rays on their way out"}, spawned_bundles},
    Item{"shader_unit", {"attribute_cache", "pJ", "Look-ups and fills"}, attribute_cache},
    Item{"shader_unit", {"texture_cache", "pJ", "Look-ups and fills"}, texture_cache},
    Item{"shader_cache", {"cells", "pJ", "Rays and hits in and out"}, shader_cache_cells},
    Item{"ray_cache", {"key", "pJ", "The heuristic's arithmetic"}, ray_cache_key},
    Item{"ray_cache", {"cells", "pJ", "Rays into cells and out of them"}, ray_cache_cells},
    Item{"spawned_rays",
         {"queue", "pJ", "Rays through the queue before the ray cache or router"},
         spawned_rays},
    Item{"packet_store", {"accesses", "pJ", "Rays and hits of packets in flight"}, packet_store},
    Item{"film", {"addition", "pJ", "Adders of the three channels"}, film_addition},
    Item{"film", {"film_cache", "pJ", "Pixels, fills and write-backs"}, film_cache},
    Item{"l2", {"array", "pJ", "Lines read and written"}, l2_array},
    Item{"dram", {"fixed", "pJ", "Memory of fixed latency: there is no such device"}, fixed_dram},
    Item{"dram", DramEnergyValues::activate_precharge,
         banked_dram<DramEnergyValues::activate_precharge>},
    Item{"dram", DramEnergyValues::read, banked_dram<DramEnergyValues::read>},
    Item{"dram", DramEnergyValues::write, banked_dram<DramEnergyValues::write>},
    Item{"dram", DramEnergyValues::refresh, banked_dram<DramEnergyValues::refresh>},
    Item{"dram", DramEnergyValues::active_standby, banked_dram<DramEnergyValues::active_standby>},
    Item{"dram", DramEnergyValues::precharge_standby,
         banked_dram<DramEnergyValues::precharge_standby>},
    Item{"dram", {"interface", "pJ", "Vpp, termination, controller and its pads"}, unknown},
    Item{"machine", {"control", "pJ", "Schedulers, queues, MSHRs, pipeline registers"}, unknown},
    Item{"machine", {"links", "pJ", "Wires: there is no floor plan"}, unknown},
    Item{"machine", {"clock_tree", "pJ", "Distribution of the clock"}, unknown},
    Item{"machine", {"leakage", "pJ", "What flows whether anything happens or not"}, unknown},
};

void append(std::string& list, std::string_view name) {
  if (!list.empty()) list += ", ";
  list += name;
}

void report_items(const Run& run, StatsTree& stats) {
  double known = 0;
  std::string unknown_items;
  for (const Item& item : kItems) {
    const Energy energy = item.of(run);
    if (!energy.built) continue;
    stats.add_real(fmt::format("energy.{}", item.unit), item.info, energy.picojoule);
    known += energy.picojoule.value_or(0);
    if (!energy.picojoule) append(unknown_items, fmt::format("{}.{}", item.unit, item.info.name));
  }
  stats.add_text("energy", EnergyValues::node, std::string(kTechnologyNode));
  stats.add_real("energy", EnergyValues::known, known);
  stats.add_text("energy", EnergyValues::unknown, unknown_items);
  stats.add_ratio("energy", EnergyValues::per_ray, known,
                  run.counts.of("rays.num_retired").value_or(0));
  const double seconds = run.counts.of("system.seconds").value_or(0);
  stats.add_ratio("energy", EnergyValues::power, known * 1e-12, seconds);
}

void report_area(const Run& run, StatsTree& stats) {
  std::uint64_t sum = 0;
  std::string unknown_parts = "logic, wires, pads";
  for (const Sram& sram : run.srams) {
    if (!sram.bits) {
      append(unknown_parts, sram.name);
      continue;
    }
    const std::uint64_t bits = sram.count * *sram.bits;
    const std::string path = fmt::format("area.{}", sram.name);
    stats.add(path, SramValues::bits, bits);
    stats.add_real(path, SramValues::mm2, sram_square_millimetres(static_cast<double>(bits)));
    sum += bits;
  }
  stats.add("area", AreaValues::sram_bits, sum);
  stats.add_real("area", AreaValues::sram_mm2, sram_square_millimetres(static_cast<double>(sum)));
  stats.add_text("area", AreaValues::unknown, unknown_parts);
}

/// The items of one unit stand together in kItems.
std::vector<CounterInfo> infos_of(std::string_view unit) {
  std::vector<CounterInfo> infos;
  for (const Item& item : kItems) {
    if (item.unit == unit) infos.push_back(item.info);
  }
  return infos;
}

}  // namespace

void report_energy(const Config& config, const BuildPlan& plan, StatsTree& stats) {
  const Run run(config, plan, stats);
  report_items(run, stats);
  report_area(run, stats);
}

std::vector<CounterGroup> energy_groups() {
  static const std::vector<std::pair<std::string, std::vector<CounterInfo>>> kUnits = [] {
    std::vector<std::pair<std::string, std::vector<CounterInfo>>> units;
    for (const Item& item : kItems) {
      const std::string path = fmt::format("energy.{}", item.unit);
      if (units.empty() || units.back().first != path)
        units.emplace_back(path, infos_of(item.unit));
    }
    return units;
  }();
  std::vector<CounterGroup> groups{
      {"energy", "The machine as a whole; see sheaf coefficients", EnergyValues::infos()},
      {"area", "The machine as a whole", AreaValues::infos()},
      {"area.<memory>", "One kind of SRAM", SramValues::infos()}};
  for (const auto& [path, infos] : kUnits) {
    groups.push_back({path, "Counts x coefficients, all units of the kind; none: unknown", infos});
  }
  return groups;
}

}  // namespace sheaf
