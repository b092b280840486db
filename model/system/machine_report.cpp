// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "system/clocked_machine.h"
#include "system/machine.h"
#include "system/report_parts.h"
#include "system/reported_values.h"

namespace sheaf {

template <typename Kind>
void MachineParts<Kind>::report(StatsTree& stats) const {
  const double seconds = static_cast<double>(end_) / config_.clock.frequency;
  stats.add("system", SystemValues::cycles, end_);
  stats.add_real("system", SystemValues::seconds, seconds);
  stats.add_ratio("system", SystemValues::frames_per_second, complete_ ? 1.0 : 0.0, seconds);
  const auto rays = static_cast<double>(frame_.rays.total().retired);
  stats.add_ratio("system", SystemValues::rays_per_cycle, rays, static_cast<double>(end_));
  stats.add("system", SystemValues::max_rays_in_flight, flow_.max_live());
  stats.add("system", SystemValues::packets_made, packets_.num_made());
  stats.add("system", SystemValues::num_wakes, num_wakes_);
  report_units(stats);
  report_links(stats);
  report_memory(stats);
}

template <typename Kind>
void MachineParts<Kind>::report_units(StatsTree& stats) const {
  const auto unit = [&](const std::string& path, const auto& module) {
    stats.add_counters(path, module.stalls());
  };
  stats.add_counters("system.primary_source", primary_source_->stats());
  unit("system.primary_source", *primary_source_);
  stats.add_counters("system.packet_arbiter", packet_arbiter_->stats());
  unit("system.packet_arbiter", *packet_arbiter_);
  if (ray_cache_) {
    report_sorter(ray_cache_->sorter(), "system.ray_cache", stats);
    unit("system.ray_cache", *ray_cache_);
  }
  if (spawn_router_) {
    stats.add_counters("system.spawn_router", spawn_router_->stats());
    unit("system.spawn_router", *spawn_router_);
  }
  if (spill_) {
    stats.add_counters("system.spill", spill_->stats());
    stats.add_ratio("system.spill", SpillValues::mean_spill_latency,
                    spill_->stats().sum_spill_latency, spill_->stats().num_bundles_spilled);
    unit("system.spill", *spill_);
  }
  TraceCounts primary;
  TraceCounts secondary;
  for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
    const auto& traversal = *traversal_units_[i];
    const std::string path = fmt::format("system.traversal_unit{}", i);
    stats.add_counters(path, traversal.pipeline_stats());
    unit(path, traversal);
    primary += traversal.primary_counts();
    secondary += traversal.secondary_counts();
  }
  for (std::size_t i = 0; i < intersection_units_.size(); ++i) {
    const std::string path = fmt::format("system.intersection_unit{}", i);
    stats.add_counters(path, intersection_units_[i]->pipeline_stats());
    unit(path, *intersection_units_[i]);
  }
  for (std::size_t i = 0; i < shader_units_.size(); ++i) {
    const std::string path = fmt::format("system.shader_unit{}", i);
    stats.add_counters(path, shader_units_[i]->pipeline_stats());
    unit(path, *shader_units_[i]);
  }
  if (shader_cache_) {
    report_shading_sorter(shader_cache_->sorter(), "system.shader_cache", stats);
    unit("system.shader_cache", *shader_cache_);
  }
  stats.add_counters("system.film", film_->stats());
  unit("system.film", *film_);
  report_traces(primary, secondary, plan_.secondary_rays, stats);
}

template <typename Kind>
void MachineParts<Kind>::report_links(StatsTree& stats) const {
  const auto link = [&](const std::string& path, const auto& channel) {
    stats.add(path, LinkValues::num_written, channel.num_written());
    stats.add(path, LinkValues::max_occupancy, channel.max_size());
    stats.add(path, LinkValues::occupancy_cycles, channel.occupancy_cycles());
    stats.add_ratio(path, LinkValues::mean_residence, channel.occupancy_cycles(),
                    channel.num_written());
  };
  link("system.link.source_to_arbiter", *links_.source_to_arbiter);
  if (links_.packet_fifo) link("system.packet_fifo", *links_.packet_fifo);
  if (links_.spawned_rays) link("system.link.spawned_rays", *links_.spawned_rays);
  for (const auto& channel : links_.traversal_to_intersection) {
    link(fmt::format("system.link.{}", channel->name()), *channel);
  }
  for (const auto& channel : links_.traversal_to_shader) {
    link(fmt::format("system.link.{}", channel->name()), *channel);
  }
  for (const auto& channel : links_.traversal_to_shader_cache) {
    link(fmt::format("system.link.{}", channel->name()), *channel);
  }
  for (const auto& channel : links_.shader_cache_to_shader) {
    link(fmt::format("system.link.{}", channel->name()), *channel);
  }
  link("system.link.shader_to_film", *links_.shader_to_film);
}

template <typename Kind>
void MachineParts<Kind>::report_memory(StatsTree& stats) const {
  const auto cache = [&](const std::string& path, const auto& module) {
    report_cache(path, module, stats);
  };
  for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
    cache(fmt::format("system.traversal_unit{}.node_cache", i), traversal_units_[i]->cache());
  }
  for (std::size_t i = 0; i < intersection_units_.size(); ++i) {
    cache(fmt::format("system.intersection_unit{}.triangle_cache", i),
          intersection_units_[i]->cache());
  }
  for (std::size_t i = 0; i < shader_units_.size(); ++i) {
    cache(fmt::format("system.shader_unit{}.attribute_cache", i),
          shader_units_[i]->attribute_cache());
    const auto* texture = shader_units_[i]->texture_cache();
    if (texture != nullptr) cache(fmt::format("system.shader_unit{}.texture_cache", i), *texture);
  }
  cache("system.film.cache", film_->cache());
  memory_->report(end_, frame_.rays.total().retired, spill_ != nullptr, stats);
}

template void MachineParts<TimedKind>::report(StatsTree& stats) const;
template void MachineParts<ClockedKind>::report(StatsTree& stats) const;

}  // namespace sheaf
