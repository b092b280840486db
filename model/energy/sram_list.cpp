// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/sram_list.h"

#include <algorithm>
#include <bit>

#include "energy/coefficients.h"
#include "kdtree/kd_tree.h"
#include "kdtree/memory_map.h"
#include "units/flow_control.h"

namespace sheaf {
namespace {

std::uint64_t ceil_log2(std::uint64_t x) {
  return x <= 1 ? 0 : static_cast<std::uint64_t>(std::bit_width(x - 1));
}
std::uint64_t floor_log2(std::uint64_t x) {
  return static_cast<std::uint64_t>(std::bit_width(x)) - 1;
}

// Of them those that wait before the ray cache, of whom all may.
std::uint64_t rays_in_loop(const Config& config, std::uint32_t lights, std::uint32_t branches) {
  if (config.flow.control == FlowPolicy::kSpill) return config.flow.spill_queue;
  const std::uint64_t one_ray = WorstCase(config.render.recursion_level, lights, branches).of({});
  const std::uint64_t side = config.flow.tile_size;
  if (config.flow.control == FlowPolicy::kTile) return one_ray * side * side;
  if (config.flow.credits != 0) return config.flow.credits;
  return one_ray * std::max<std::uint64_t>(side * side, config.packet.size);
}

std::uint64_t packets_in_store(const Config& config, const BuildPlan& plan) {
  const std::uint64_t units = config.traversal_unit.count;
  const std::uint64_t shaders = config.shader_unit.count;
  const std::uint64_t to_shaders = plan.shader_cache ? units + shaders : units * shaders;
  return units * config.traversal_unit.contexts + shaders * config.shader_unit.contexts +
         (plan.secondary_rays ? config.packet_fifo.depth : 0) +
         config.link.depth * (1 + to_shaders);
}

// Data and tags, with a valid and a dirty bit a sector.
template <typename Spec>
std::uint64_t cache_bits(const Spec& spec, std::uint64_t address_bits) {
  const std::uint64_t lines = spec.capacity / spec.line;
  const std::uint64_t sets = std::max<std::uint64_t>(1, lines / spec.ways);  // of all banks
  const std::uint64_t index = floor_log2(spec.line) + floor_log2(sets);
  const std::uint64_t tag = address_bits > index ? address_bits - index : 0;
  return 8 * spec.capacity + lines * (tag + 2 * std::uint64_t{spec.sectors});
}

class List {
 public:
  List(const Config& config, const BuildPlan& plan, const MachineSizes& sizes)
      : c_(config), plan_(plan), sizes_(sizes), n_(config.packet.size) {}

  std::vector<Sram> make() {
    traversal();
    intersection();
    shader();
    if (plan_.secondary_rays) regrouper();
    cache("film_cache", 1, c_.film_cache);
    cache("l2", 1, c_.l2);
    add("packet_store", 1, sizes_.packets_in_store * n_ * (sizes_.ray_bits + sizes_.hit_bits), n_);
    return list_;
  }

 private:
  void add(std::string_view name, std::uint64_t count, std::optional<std::uint64_t> bits,
           std::uint64_t banks = 1) {
    list_.push_back({name, count, bits, banks});
  }
  template <typename Spec>
  void cache(std::string_view name, std::uint64_t count, const Spec& spec) {
    if (spec.mode == CacheMode::kAbsent) return;
    if (spec.mode == CacheMode::kPerfect) return add(name, count, {});
    add(name, count, cache_bits(spec, sizes_.address_bits), spec.banks);
  }
  [[nodiscard]] std::uint64_t lanes(const UnitSpec& unit) const {
    return std::min<std::uint64_t>(unit.lanes, n_);
  }

  void traversal() {
    const UnitSpec& unit = c_.traversal_unit;
    const std::uint64_t rays = std::uint64_t{unit.contexts} * n_;
    add("prepared_rays", unit.count, rays * (288 + 64 + 32), lanes(unit));
    const bool interval =
        c_.traversal_scheme == Scheme::kInterval || c_.traversal_scheme == Scheme::kIntervalEntry;
    const std::uint64_t entry = interval ? 30 + 8 * 32 : 30 + n_ + 64 * n_;
    add("traversal_stack", unit.count, unit.contexts * std::uint64_t{kMaxKdDepth} * entry);
    cache("node_cache", unit.count, c_.node_cache);
  }
  void intersection() {
    const UnitSpec& unit = c_.intersection_unit;
    add("sheared_rays", unit.count, std::uint64_t{unit.contexts} * n_ * (96 + 96 + 2 + 32),
        lanes(unit));
    add("leaf_lists", unit.count, std::uint64_t{unit.contexts} * c_.triangle_cache.line * 8);
    cache("triangle_cache", unit.count, c_.triangle_cache);
  }
  void shader() {
    const UnitSpec& unit = c_.shader_unit;
    const std::uint64_t rays = std::uint64_t{unit.contexts} * n_;
    add("fetched_attributes", unit.count, rays * (3 * 256 + 512), lanes(unit));
    if (plan_.secondary_rays) {
      add("spawned_bundles", unit.count, rays * sizes_.spawned_per_ray * sizes_.ray_bits,
          lanes(unit));
    }
    cache("attribute_cache", unit.count, c_.attribute_cache);
    if (plan_.texture_cache) cache("texture_cache", unit.count, c_.texture_cache);
    if (plan_.shader_cache) {
      add("shader_cache", 1, c_.shader_cache.cells * n_ * (sizes_.ray_bits + sizes_.hit_bits), n_);
    }
  }
  void regrouper() {
    if (plan_.ray_cache) add("ray_cache", 1, ray_cache_bits(), n_);
    const bool could_be_built = sizes_.rays_in_loop <= WorstCase::kCeiling;
    add("spawned_rays", 1,
        could_be_built ? std::optional(sizes_.rays_in_loop * sizes_.ray_bits) : std::nullopt);
  }
  [[nodiscard]] std::optional<std::uint64_t> ray_cache_bits() const {
    using Kind = HeuristicChoice::Kind;
    const Kind kind = plan_.heuristic.kind;
    if (kind == Kind::kOpos || c_.ray_cache.order == RayOrder::kBreadthFirst) return {};
    const std::uint64_t cells =
        c_.ray_cache.cells != 0 ? c_.ray_cache.cells : plan_.heuristic.natural_cells();
    const std::uint64_t link = kind == Kind::kGrid ? ceil_log2(cells * n_) : 0;
    const std::uint64_t anchor = kind == Kind::kPos ? 96 : 0;
    return cells * (n_ * (sizes_.ray_bits + link) + anchor);
  }

  const Config& c_;
  const BuildPlan& plan_;
  const MachineSizes& sizes_;
  const std::uint64_t n_;
  std::vector<Sram> list_;
};

}  // namespace

MachineSizes machine_sizes(const Config& config, const BuildPlan& plan, const StatsTree& stats) {
  MachineSizes sizes;
  const auto lights =
      static_cast<std::uint32_t>(plan.shadow_rays ? stats.count("scene.lights") : 0);
  const std::uint32_t branches =
      (plan.reflection_rays ? 1U : 0U) + (plan.refraction_rays ? 1U : 0U);
  const std::uint64_t pixels = std::uint64_t{config.image.width} * config.image.height;
  // Origin, direction, t_max, weight, kind, pixel, depth.
  sizes.ray_bits = 96 + 96 + 32 + 96 + 2 + ceil_log2(pixels) +
                   ceil_log2(std::uint64_t{config.render.recursion_level} + 2);
  sizes.address_bits = ceil_log2(MemoryMap::kBase + stats.count("memory.footprint"));
  sizes.spawned_per_ray = branches + lights;
  sizes.rays_in_loop = rays_in_loop(config, lights, branches);
  sizes.packets_in_store = packets_in_store(config, plan);
  return sizes;
}

std::optional<double> Sram::word_picojoule() const {
  if (!bits) return {};
  return sram_word_picojoule(static_cast<double>(*bits) / 8.0 / static_cast<double>(banks));
}

std::vector<Sram> list_srams(const Config& config, const BuildPlan& plan,
                             const MachineSizes& sizes) {
  return List(config, plan, sizes).make();
}

}  // namespace sheaf
