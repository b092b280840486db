// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/analytic_model.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "config/dram/device.h"
#include "image/film.h"
#include "scene/tile_order.h"
#include "system/pipeline_parts.h"

namespace sheaf {
namespace {

double peak_bytes_per_cycle(const Config& config) {
  if (config.dram.model == DramModel::kFixed) {
    return static_cast<double>(config.dram.bytes_per_cycle);
  }
  return resolve_dram(config.dram).peak_bandwidth() / config.clock.frequency;
}

// Of a read that finds its bank closed and its queue empty.
Cycles idle_latency(const Config& config) {
  if (config.dram.model == DramModel::kFixed) return config.dram.latency;
  const DramDevice device = resolve_dram(config.dram);
  const Cycles clocks = device.timing.tRCD + device.timing.tCL + device.timing.tBL;
  return static_cast<Cycles>(std::ceil(static_cast<double>(clocks) * config.clock.frequency /
                                       static_cast<double>(device.clock_hz)));
}

std::size_t depth_of(const RayPacket& packet) {
  std::size_t depth = 0;
  for (LaneMask left = packet.active; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    depth = std::max<std::size_t>(depth, packet.tag[lane].depth);
  }
  return depth;
}

bool is_primary(const RayPacket& packet) {
  const auto lane = static_cast<std::size_t>(std::countr_zero(packet.active));
  return packet.tag[lane].kind == RayKind::kPrimary;
}

Cycles slots_of(const UnitSpec& unit, const Config& config) {
  return (config.packet.size + unit.lanes - 1) / unit.lanes;
}

Cycles shared_by(Cycles cycles, std::uint64_t count) {
  return (cycles + count - 1) / count;
}

Cycles largest(const BoundCycles& bounds) {
  Cycles largest = 0;
  bounds.for_each(
      [&](const CounterInfo& /*info*/, Cycles bound) { largest = std::max(largest, bound); });
  return largest;
}

}  // namespace

std::uint32_t num_tiles(const Config& config) {
  return TileOrder(config.image.width, config.image.height, config.flow.tile_size, 1).num_tiles();
}

AnalyticModel::AnalyticModel(const Config& config, const PreparedScene& scene)
    : config_(config),
      scene_(scene),
      dram_bytes_per_cycle_(peak_bytes_per_cycle(config)),
      dram_latency_(idle_latency(config)),
      bytes_per_pixel_(make_film(config.film.format, 1)->bytes_per_pixel()),
      tags_(config),
      tiles_(num_tiles(config)) {}

bool AnalyticModel::run(FunctionalPipeline& pipeline, const FunctionalPipeline::Monitor& monitor) {
  pipeline_ = &pipeline;
  const bool complete = pipeline.run(monitor);
  if (complete) {
    tags_.flush();
    end_tile();
  }
  return complete;
}

void AnalyticModel::tile_begins(std::uint32_t tile) {
  if (in_tile_) end_tile();
  if (tile == snapshot_at_) snapshot_.emplace(tags_);
  in_tile_ = true;
  tile_ = tile;
}

Observation AnalyticModel::observe() const {
  Observation seen;
  tags_.observe(seen);
  pipeline_->observe(seen);
  return seen;
}

void AnalyticModel::end_tile() {
  const Observation now = observe();
  TileWork& work = tiles_[tile_];
  work.seen = now.since(tile_start_);
  work.bounds = bounds(demand_, work.seen);
  work.seen[Observed::kCycles] = largest(work.bounds);
  tile_start_ = now;
  demand_ = {};
}

TileWork AnalyticModel::frame() const {
  TileWork frame;
  for (const TileWork& tile : tiles_) {
    frame.seen += tile.seen;
    frame.bounds += tile.bounds;
  }
  if (config_.flow.control != FlowPolicy::kTile) {
    frame.seen[Observed::kCycles] = largest(frame.bounds);
  }
  return frame;
}

BoundCycles AnalyticModel::bounds(const Demand& demand, const Observation& seen) const {
  const auto contexts = [](const UnitSpec& unit) {
    return std::uint64_t{unit.count} * unit.contexts;
  };
  BoundCycles bounds;
  bounds.primary_source = demand.primary_packets * config_.primary_source.interval;
  bounds.ray_cache = shared_by(demand.spawned_rays, config_.ray_cache.rays_per_cycle);
  bounds.traversal_issue = shared_by(demand.traversal.issue, config_.traversal_unit.count);
  bounds.traversal_contexts = shared_by(demand.traversal.latency, contexts(config_.traversal_unit));
  bounds.intersection_issue = shared_by(demand.intersection.issue, config_.intersection_unit.count);
  bounds.intersection_contexts =
      shared_by(demand.intersection.latency, contexts(config_.intersection_unit));
  bounds.shader_issue = shared_by(demand.shader.issue, config_.shader_unit.count);
  bounds.shader_contexts = shared_by(demand.shader.latency, contexts(config_.shader_unit));
  bounds.film = demand.contributions;
  bounds.l2_banks = shared_by(seen[Observed::kL2Accesses], config_.l2.banks);
  bounds.dram_bus =
      static_cast<Cycles>(static_cast<double>(seen[Observed::kDramBytes]) / dram_bytes_per_cycle_);
  if (config_.flow.control == FlowPolicy::kTile) {
    for (const auto* longest : {&demand.longest_walk, &demand.longest_shading}) {
      for (const Cycles cycles : *longest) bounds.serial += cycles;
    }
  }
  return bounds;
}

Cycles AnalyticModel::latency_of(TagHierarchy::Served served) const {
  if (served == TagHierarchy::Served::kPrivate) return 0;
  const Cycles l2 = 2 * config_.link.memory_latency + config_.l2.hit_latency;
  return served == TagHierarchy::Served::kL2 ? l2 : l2 + dram_latency_;
}

// As MultiContextUnit has it: a step that misses takes an interval of the port, and is issued again
// when its lines are there.
AnalyticModel::Spent AnalyticModel::step(const UnitSpec& unit, Cycles slots, Cycles hit_latency,
                                         Cycles lookups, Cycles miss) {
  const Cycles port = std::max(slots * unit.initiation_interval, miss != 0 ? 0 : lookups);
  const Cycles attempt = miss != 0 ? std::max(unit.initiation_interval, lookups) : 0;
  return {attempt + port, miss + port - 1 + hit_latency};
}

// Returns the latency of the slowest line, 0 if all were there.
Cycles AnalyticModel::read_lines(Cache cache, std::size_t unit, Address first, Bytes bytes,
                                 Cycles& lookups) {
  const std::uint64_t last = tags_.line_of(cache, first + bytes - 1);
  Cycles slowest = 0;
  lookups = 0;
  for (std::uint64_t line = tags_.line_of(cache, first); line <= last; ++line) {
    slowest = std::max(slowest, latency_of(tags_.read(cache, unit, line)));
    ++lookups;
  }
  return slowest;
}

void AnalyticModel::traced(const RayPacket& packet, const TraceLog& log) {
  const UnitSpec& unit = config_.traversal_unit;
  const std::size_t number = next_traversal_;
  next_traversal_ = (next_traversal_ + 1) % unit.count;
  if (is_primary(packet)) ++demand_.primary_packets;
  const Cycles slots = slots_of(unit, config_);
  const TraversalScheme scheme = scheme_of(config_.traversal_scheme);

  Spent walk = step(unit, slots, unit.latency, 0, 0);  // set-up
  for (const TraceStep& at : log) {
    Cycles lookups = 0;
    const Cycles miss = read_lines(Cache::kNode, number, scene_.memory.node(at.node), 1, lookups);
    walk += step(unit, step_slots(scheme, at, static_cast<std::uint32_t>(slots)),
                 config_.node_cache.hit_latency + unit.latency, 1, miss);
    if (at.num_tests == 0) continue;
    const Spent job = leaf_job(at.node, at.num_tests);
    demand_.intersection += job;
    walk.latency += 2 * config_.link.latency + job.latency;
  }
  demand_.traversal += walk;
  auto& longest = demand_.longest_walk;
  longest.resize(std::max(longest.size(), depth_of(packet) + 1));
  Cycles& at_depth = longest[depth_of(packet)];
  at_depth = std::max(at_depth, walk.latency);
}

AnalyticModel::Spent AnalyticModel::leaf_job(std::uint32_t leaf, std::uint32_t num_tests) {
  const UnitSpec& unit = config_.intersection_unit;
  const Cycles hit = config_.triangle_cache.hit_latency;
  const std::size_t number = next_intersection_;
  next_intersection_ = (next_intersection_ + 1) % unit.count;
  const std::uint32_t first = scene_.tree.nodes[leaf].first();
  Cycles lookups = 0;
  Cycles miss = read_lines(Cache::kTriangle, number, scene_.memory.leaf_entry(first),
                           num_tests * MemoryMap::kLeafEntrySize, lookups);
  Spent job = step({.initiation_interval = 1}, 1, hit, lookups, miss);
  for (std::uint32_t i = 0; i < num_tests; ++i) {
    const std::uint32_t triangle = scene_.tree.leaf_triangles[first + i];
    miss = read_lines(Cache::kTriangle, number, scene_.memory.triangle(triangle),
                      MemoryMap::kTriangleSize, lookups);
    job += step(unit, slots_of(unit, config_), hit + unit.latency, lookups, miss);
  }
  return job;
}

// One of the shader's phases: all lines at once, each once.
AnalyticModel::Spent AnalyticModel::fetch_lines(Cache cache, const CacheSpec& spec,
                                                std::vector<std::uint64_t>& lines) {
  if (lines.empty()) return {};
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  Cycles slowest = 0;
  for (const std::uint64_t line : lines) {
    slowest = std::max(slowest, latency_of(tags_.read(cache, next_shader_, line)));
  }
  const Spent spent = step({.initiation_interval = 1}, 1, spec.hit_latency, lines.size(), slowest);
  lines.clear();
  return spent;
}

void AnalyticModel::shaded(const RayPacket& packet, const PacketShading& shading) {
  const UnitSpec& unit = config_.shader_unit;
  const MemoryMap& memory = scene_.memory;
  const auto add_line = [&](Cache cache, Address address) {
    lines_.push_back(tags_.line_of(cache, address));
  };
  for (const std::uint32_t triangle : shading.triangles) {
    add_line(Cache::kAttribute, memory.triangle_indices(triangle));
  }
  Spent spent = fetch_lines(Cache::kAttribute, config_.attribute_cache, lines_);
  for (const std::uint32_t triangle : shading.triangles) {
    for (const std::uint32_t vertex : scene_.scene.triangles[triangle]) {
      add_line(Cache::kAttribute, memory.vertex(vertex));
    }
    add_line(Cache::kAttribute, memory.material(scene_.scene.triangle_material[triangle]));
  }
  spent += fetch_lines(Cache::kAttribute, config_.attribute_cache, lines_);
  for (const TexelAccess& texel : shading.texels) {
    add_line(Cache::kTexture, memory.texel(texel.texture, texel.x, texel.y));
  }
  spent += fetch_lines(Cache::kTexture, config_.texture_cache, lines_);
  const Cycles slots = slots_of(unit, config_);
  const bool only_post = shading.triangles.empty();
  spent += step(unit, only_post ? 1 : slots, unit.latency, only_post ? slots : 0, 0);
  next_shader_ = (next_shader_ + 1) % unit.count;

  demand_.shader += spent;
  demand_.spawned_rays += shading.spawned.rays.size();
  demand_.contributions += shading.contributions.size();
  auto& longest = demand_.longest_shading;
  longest.resize(std::max(longest.size(), depth_of(packet) + 1));
  Cycles& at_depth = longest[depth_of(packet)];
  at_depth = std::max(at_depth, spent.latency + 3 * config_.link.latency);

  add_to_film(shading);
}

// A batch takes a cycle a contribution, so that a line it asked for is not there before it ends.
void AnalyticModel::add_to_film(const PacketShading& shading) {
  for (const PixelContribution& contribution : shading.contributions) {
    const Address pixel = scene_.memory.pixel(contribution.pixel);
    const std::uint64_t last = tags_.line_of(Cache::kFilm, pixel + bytes_per_pixel_ - 1);
    for (std::uint64_t line = tags_.line_of(Cache::kFilm, pixel); line <= last; ++line) {
      if (std::ranges::find(lines_, line) != lines_.end()) {
        tags_.merge_film();
      } else if (tags_.modify_film(line, bytes_per_pixel_) != TagHierarchy::Served::kPrivate) {
        lines_.push_back(line);
      }
    }
  }
  lines_.clear();
}

}  // namespace sheaf
