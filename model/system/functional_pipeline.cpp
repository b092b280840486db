// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/functional_pipeline.h"

#include <bit>

#include "system/pipeline_parts.h"
#include "system/report_parts.h"
#include "units/primary_source.h"

namespace sheaf {

FunctionalPipeline::FunctionalPipeline(const Config& config, const BuildPlan& plan,
                                       const PreparedScene& scene, Frame& frame,
                                       const RunHooks& hooks, FunctionalObserver* observer)
    : config_(config),
      plan_(plan),
      scene_(scene),
      frame_(frame),
      packets_(static_cast<int>(config.packet.size)),
      shader_(make_shader(config, scene.scene, frame)),
      shading_source_(hooks.shading != nullptr ? *hooks.shading : shader_),
      observer_(observer),
      flow_(make_flow_control(config, plan, scene.scene)),
      order_(config.image.width, config.image.height, config.flow.tile_size,
             static_cast<int>(config.packet.size)) {
  if (plan_.ray_cache) {
    const Box& bounds = scene.scene.bounds;
    sorter_ = make_sorter(sorter_options(config, plan, bounds), bounds, packets_);
  }
  if (plan_.shader_cache) {
    shading_sorter_ = std::make_unique<ShadingSorter>(config.shader_cache, scene.scene, packets_);
  }
}

bool FunctionalPipeline::run(const Monitor& monitor) {
  for (;;) {
    const bool secondary_first =
        config_.packet_arbiter.policy == ArbiterPolicy::kSecondaryFirst ||
        (config_.packet_arbiter.policy == ArbiterPolicy::kAlternate && !last_was_secondary_);
    RayPacket* packet = nullptr;
    bool secondary = !fifo_.empty() && secondary_first;
    if (!secondary && !next_primary(packet)) {
      if (!fifo_.empty()) {
        secondary = true;
      } else if (sweep_shader_cache() || sweep()) {
        continue;
      } else if (order_.is_done()) {
        return true;
      }
    }
    last_was_secondary_ = secondary;
    if (secondary) {
      packet = fifo_.front();
      fifo_.pop_front();
    }
    if (packet != nullptr) process(packet, secondary ? secondary_counts_ : primary_counts_);
    if (order_.num_visited() != num_monitored_) {
      num_monitored_ = order_.num_visited();
      if (monitor && monitor(static_cast<double>(num_monitored_) / order_.num_tiles()))
        return false;
    }
  }
}

// False if flow control holds the next primary packet back or there is none.
bool FunctionalPipeline::next_primary(RayPacket*& packet) {
  TileOrder::Run run;
  while (held_primary_ == nullptr) {
    if (order_.is_done()) return false;
    if (order_.next_run(run)) {
      held_primary_ = packets_.acquire();
      make_primary_packet(scene_.scene.camera, config_.image, run, *held_primary_);
    } else {
      if (flow_.by_tile() && flow_.live() != 0) return false;
      order_.next_tile();
    }
  }
  std::uint64_t reservation = 0;
  for (LaneMask left = held_primary_->active; left != 0; left &= left - 1) {
    reservation +=
        flow_.worst_case(held_primary_->tag[static_cast<std::size_t>(std::countr_zero(left))]);
  }
  if (!flow_.admits(reservation)) return false;
  packet = held_primary_;
  held_primary_ = nullptr;
  if (observer_ != nullptr && order_.tile() != last_tile_) observer_->tile_begins(order_.tile());
  last_tile_ = order_.tile();
  for (LaneMask left = packet->active; left != 0; left &= left - 1) {
    frame_.rays.spawn(packet->tag[static_cast<std::size_t>(std::countr_zero(left))]);
  }
  flow_.admit(static_cast<std::uint64_t>(std::popcount(packet->active)), reservation, 0);
  return true;
}

void FunctionalPipeline::process(RayPacket* packet, TraceCounts& counts) {
  const bool per_lane = frame_.heat.wanted();
  TraceLog* const log = observer_ != nullptr ? &log_ : nullptr;
  trace_packet(scheme_of(config_.traversal_scheme), scene_.tree, scene_.triangles, *packet, log,
               per_lane ? &lanes_ : nullptr, counts);
  if (observer_ != nullptr) observer_->traced(*packet, log_);
  if (per_lane) frame_.heat.add(*packet, lanes_);
  if (!shading_sorter_) {
    shade(packet);
    return;
  }
  to_shade_.clear();
  shading_sorter_->insert(packet, to_shade_);
  for (RayPacket* next : to_shade_) shade(next);
}

void FunctionalPipeline::shade(RayPacket* packet) {
  shading_source_.shade(*packet, shading_);
  if (observer_ != nullptr) observer_->shaded(*packet, shading_);
  for (const PixelContribution& contribution : shading_.contributions) {
    frame_.film->add(contribution.pixel, contribution.radiance);
  }
  retire(*packet);
  packets_.release(packet);
  if (!shading_.spawned.rays.empty()) spawn();
}

void FunctionalPipeline::retire(const RayPacket& packet) {
  std::uint64_t before = 0;
  for (LaneMask left = packet.active; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    frame_.rays.retire(packet.tag[i], packet.hit_triangle[i] != kNoHit);
    before += flow_.worst_case(packet.tag[i]);
  }
  std::uint64_t after = 0;
  for (const Ray& ray : shading_.spawned.rays) {
    frame_.rays.spawn(ray.tag);
    after += flow_.worst_case(ray.tag);
  }
  flow_.replace(static_cast<std::uint64_t>(std::popcount(packet.active)),
                shading_.spawned.rays.size(), before, after, 0);
}

void FunctionalPipeline::spawn() {
  departures_.clear();
  if (sorter_) {
    for (const Ray& ray : shading_.spawned.rays) sorter_->insert(ray, 0, departures_);
  } else {
    split_by_kind(shading_.spawned, packets_, departures_);
  }
  fifo_.insert(fifo_.end(), departures_.begin(), departures_.end());
}

bool FunctionalPipeline::sweep_shader_cache() {
  if (!shading_sorter_ || shading_sorter_->num_waiting() == 0) return false;
  to_shade_.clear();
  shading_sorter_->sweep(to_shade_);
  for (RayPacket* packet : to_shade_) shade(packet);
  return true;
}

bool FunctionalPipeline::sweep() {
  if (!sorter_ || sorter_->num_waiting() == 0) return false;
  departures_.clear();
  const Departure why = flow_.by_tile()    ? Departure::kSweptTile
                        : order_.is_done() ? Departure::kSweptFrame
                                           : Departure::kSweptStall;
  sorter_->sweep(why, 0, departures_);
  fifo_.insert(fifo_.end(), departures_.begin(), departures_.end());
  return true;
}

void FunctionalPipeline::observe(Observation& seen) const {
  using enum Observed;
  seen[kPrimaryRayVisits] += primary_counts_.lane_inner_visits;
  seen[kPrimaryPacketVisits] += primary_counts_.packet_inner_visits;
  seen[kSecondaryRayVisits] += secondary_counts_.lane_inner_visits;
  seen[kSecondaryPacketVisits] += secondary_counts_.packet_inner_visits;
  if (!sorter_) return;
  seen[kRayCacheHits] += sorter_->stats().num_hits;
  seen[kRayCacheInsertions] += sorter_->stats().num_insertions;
}

void FunctionalPipeline::report(StatsTree& stats) const {
  if (sorter_) report_sorter(*sorter_, "system.ray_cache", stats);
  if (shading_sorter_) report_shading_sorter(*shading_sorter_, "system.shader_cache", stats);
  report_traces(primary_counts_, secondary_counts_, plan_.secondary_rays, stats);
}

}  // namespace sheaf
