// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/clocked_machine.h"

#include <fmt/format.h>

#include "base/errors.h"
#include "system/pipeline_parts.h"

namespace sheaf {

using clocked::Link;

namespace {

constexpr std::size_t kNeverFull = Link<RayPacket*>::kUnbounded;

// How often a run looks whether it is stuck and whether it is to stop.
constexpr Cycles kWatchInterval = 1024;
// What one unit tells another without a link is felt a cycle later; after so many cycles in which
// nothing was on its way nothing will be.
constexpr Cycles kStillCycles = 16;

}  // namespace

ClockedMachine::ClockedMachine(const Config& config, const BuildPlan& plan,
                               const PreparedScene& scene, Frame& frame, const RunHooks& hooks)
    : MachineParts(config, plan, scene, frame, hooks) {
  memory_ = std::make_unique<ClockedMemory>(config_);
  build_units();
  if (plan_.secondary_rays) build_regrouper();
  connect();
  list_units();
}

void ClockedMachine::build_units() {
  const TracedScene traced{scene_.tree, scene_.triangles, scene_.memory,
                           scheme_of(config_.traversal_scheme)};
  ShadingSource& shading = hooks_.shading != nullptr ? *hooks_.shading : shader_;
  const ShadedScene shaded{scene_.scene, shading,  scene_.memory, packets_,
                           bundles_,     batches_, frame_.rays,   flow_};
  const TileOrder order(config_.image.width, config_.image.height, config_.flow.tile_size,
                        static_cast<int>(config_.packet.size));
  primary_source_ = std::make_unique<clocked::PrimarySource>(
      "primary_source", config_.primary_source, config_.image, order, scene_.scene.camera, packets_,
      frame_.rays, flow_);
  packet_arbiter_ = std::make_unique<clocked::PacketArbiter>(
      "packet_arbiter", config_.packet_arbiter, config_.traversal_unit);
  for (std::uint32_t i = 0; i < config_.traversal_unit.count; ++i) {
    traversal_units_.push_back(std::make_unique<clocked::TraversalUnit>(
        fmt::format("traversal_unit{}", i), config_.traversal_unit, config_.packet.size, traced,
        frame_.heat, static_cast<std::uint16_t>(i), memory_->make_cache(config_.node_cache)));
  }
  for (std::uint32_t i = 0; i < config_.intersection_unit.count; ++i) {
    intersection_units_.push_back(std::make_unique<clocked::IntersectionUnit>(
        fmt::format("intersection_unit{}", i), config_.intersection_unit, config_.packet.size,
        traced, memory_->make_cache(config_.triangle_cache)));
  }
  for (std::uint32_t i = 0; i < config_.shader_unit.count; ++i) {
    clocked::Cache attributes = memory_->make_cache(config_.attribute_cache);
    std::optional<clocked::Cache> textures;
    if (plan_.texture_cache) textures.emplace(memory_->make_cache(config_.texture_cache));
    shader_units_.push_back(std::make_unique<clocked::ShaderUnit>(
        fmt::format("shader_unit{}", i), config_.shader_unit, config_.packet.size, shaded,
        std::move(attributes), std::move(textures)));
  }
  if (plan_.shader_cache) {
    shader_cache_ = std::make_unique<clocked::ShaderCache>("shader_cache", config_.shader_cache,
                                                           scene_.scene, packets_, flow_);
  }
  film_ = std::make_unique<clocked::FilmUnit>("film", *frame_.film, scene_.memory, batches_, flow_,
                                              memory_->make_cache(config_.film_cache));
}

void ClockedMachine::build_regrouper() {
  links_.packet_fifo = std::make_unique<Link<RayPacket*>>(
      "packet_fifo",
      Link<RayPacket*>::Spec{.capacity = config_.packet_fifo.depth,
                             .latency = config_.packet_fifo.latency +
                                        (plan_.ray_cache ? config_.ray_cache.latency : 0)});
  const bool spills = config_.flow.control == FlowPolicy::kSpill;
  links_.spawned_rays = std::make_unique<Link<SpawnBundle*>>(
      "spawned_rays", Link<SpawnBundle*>::Spec{.capacity = spills ? config_.link.depth : kNeverFull,
                                               .latency = config_.link.latency});
  if (spills) build_spill();
  const auto attach = [&](auto& unit) {
    unit.in_bundles = spills ? links_.spill_to_regrouper.get() : links_.spawned_rays.get();
    unit.out_packets = links_.packet_fifo.get();
  };
  if (plan_.ray_cache) {
    const Box& bounds = scene_.scene.bounds;
    ray_cache_ = std::make_unique<clocked::RayCache>(
        "ray_cache", config_.ray_cache,
        make_sorter(sorter_options(config_, plan_, bounds), bounds, packets_), bundles_, flow_);
    attach(*ray_cache_);
  } else {
    spawn_router_ = std::make_unique<clocked::SpawnRouter>("spawn_router", packets_, bundles_);
    attach(*spawn_router_);
  }
}

// The queue that spills stands right before whoever takes the rays in.
void ClockedMachine::build_spill() {
  links_.spill_to_regrouper = std::make_unique<Link<SpawnBundle*>>(
      "spill_to_regrouper", Link<SpawnBundle*>::Spec{.capacity = 2, .latency = 1});
  const Bytes line = config_.l2.line / config_.l2.sectors;
  const ClockedMemory::Requester requester = memory_->add_requester(line);
  spill_ = std::make_unique<clocked::SpillUnit>(
      "spill",
      SpillUnit::Spec{.queue = config_.flow.spill_queue,
                      .line = line,
                      .base = scene_.memory.region(DataKind::kSpilledRay).base,
                      .requester = requester.number},
      requester.requests, requester.lines);
  spill_->in_bundles = links_.spawned_rays.get();
  spill_->out_bundles = links_.spill_to_regrouper.get();
}

// One more link with `link.depth` credits.
template <typename T>
Link<T>& ClockedMachine::add_link(Channels<T>& links, const std::string& name) {
  links.push_back(std::make_unique<Link<T>>(
      name,
      typename Link<T>::Spec{.capacity = config_.link.depth, .latency = config_.link.latency}));
  return *links.back();
}

void ClockedMachine::connect() {
  const Cycles latency = config_.link.latency;
  const std::size_t depth = config_.link.depth;
  links_.source_to_arbiter = std::make_unique<Link<RayPacket*>>(
      "source_to_arbiter", Link<RayPacket*>::Spec{.capacity = depth, .latency = latency});
  links_.traversal_to_arbiter = std::make_unique<Link<ContextFree>>(
      "traversal_to_arbiter", Link<ContextFree>::Spec{.latency = latency, .interval = 0});
  links_.shader_to_film = std::make_unique<Link<FilmBatch*>>(
      "shader_to_film", Link<FilmBatch*>::Spec{.capacity = depth, .latency = latency});
  primary_source_->out_packets = links_.source_to_arbiter.get();
  packet_arbiter_->in_primary = links_.source_to_arbiter.get();
  packet_arbiter_->in_secondary = links_.packet_fifo.get();
  packet_arbiter_->in_free = links_.traversal_to_arbiter.get();
  film_->in_batches = links_.shader_to_film.get();
  for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
    clocked::TraversalUnit& unit = *traversal_units_[i];
    links_.arbiter_to_traversal.push_back(std::make_unique<Link<RayPacket*>>(
        fmt::format("arbiter_to_traversal{}", i), Link<RayPacket*>::Spec{.latency = latency}));
    links_.intersection_to_traversal.push_back(
        std::make_unique<Link<LeafDone>>(fmt::format("intersection_to_traversal{}", i),
                                         Link<LeafDone>::Spec{.latency = latency, .interval = 0}));
    packet_arbiter_->out_packets.push_back(links_.arbiter_to_traversal.back().get());
    unit.in_packets = links_.arbiter_to_traversal.back().get();
    unit.in_done = links_.intersection_to_traversal.back().get();
    unit.out_free = links_.traversal_to_arbiter.get();
  }
  for (auto& unit : intersection_units_) {
    for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
      auto& jobs = add_link(links_.traversal_to_intersection,
                            fmt::format("traversal{}_to_{}", i, unit->name()));
      traversal_units_[i]->out_jobs.add(jobs);
      unit->in_jobs.add(jobs);
      unit->out_done.push_back(links_.intersection_to_traversal[i].get());
    }
  }
  connect_shaders();
}

void ClockedMachine::connect_shaders() {
  for (std::size_t i = 0; shader_cache_ && i < traversal_units_.size(); ++i) {
    auto& packets =
        add_link(links_.traversal_to_shader_cache, fmt::format("traversal{}_to_shader_cache", i));
    traversal_units_[i]->out_packets.add(packets);
    shader_cache_->in_packets.add(packets);
  }
  for (auto& shader : shader_units_) {
    shader->out_film = links_.shader_to_film.get();
    shader->out_bundles = links_.spawned_rays.get();
    if (shader_cache_) {
      auto& packets = add_link(links_.shader_cache_to_shader,
                               fmt::format("shader_cache_to_{}", shader->name()));
      shader_cache_->out_packets.add(packets);
      shader->in_packets.add(packets);
      continue;
    }
    for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
      auto& packets =
          add_link(links_.traversal_to_shader, fmt::format("traversal{}_to_{}", i, shader->name()));
      traversal_units_[i]->out_packets.add(packets);
      shader->in_packets.add(packets);
    }
  }
}

// Their order matters only where several write into one link in the same cycle.
void ClockedMachine::list_units() {
  units_ = {primary_source_.get(), packet_arbiter_.get()};
  for (const auto& unit : traversal_units_) units_.push_back(unit.get());
  for (const auto& unit : intersection_units_) units_.push_back(unit.get());
  for (const auto& unit : shader_units_) units_.push_back(unit.get());
  if (shader_cache_) units_.push_back(shader_cache_.get());
  units_.push_back(film_.get());
  if (spill_) units_.push_back(spill_.get());
  if (ray_cache_) units_.push_back(ray_cache_.get());
  if (spawn_router_) units_.push_back(spawn_router_.get());
}

void ClockedMachine::tick(Cycles now) {
  memory_->tick(now);
  for (clocked::Unit* unit : units_) unit->tick(now);
  num_wakes_ += units_.size();
}

bool ClockedMachine::is_at_rest() const {
  return film_->is_done() && memory_->l2().is_idle();
}

bool ClockedMachine::run(const Monitor& monitor) {
  const Cycles limit = config_.run.max_cycles != 0 ? config_.run.max_cycles : kNever;
  Cycles now = 0;
  bool stopped = false;
  for (; now != limit && !is_at_rest() && !stopped; ++now) {
    tick(now);
    if (now % kWatchInterval == 0 || still_since_ != kNever) check_progress(now);
    if (now % kWatchInterval == 0 && monitor) stopped = monitor(primary_source_->progress(), now);
  }
  end_ = now;
  complete_ = is_at_rest();
  finish_accounts(end_);
  if (!complete_) return false;
  // What has been written may still be on its way to memory.
  memory_->drain(now);
  check_conservation();
  return true;
}

// Nothing is on its way, and no unit works at anything.
bool ClockedMachine::is_still(Cycles now) const {
  bool moving = memory_->l2().is_moving() || (ray_cache_ && ray_cache_->will_time_out());
  for (const auto* unit : units_) moving |= unit->stalls().cause() == StallCause::kBusy;
  links_.for_each([&](const auto& link) { moving |= link.is_moving(now); });
  memory_->for_each_link([&](const auto& link) { moving |= link.is_moving(now); });
  return !moving;
}

void ClockedMachine::check_progress(Cycles now) {
  if (!is_still(now)) {
    still_since_ = kNever;
  } else if (still_since_ == kNever) {
    still_since_ = now;
  } else if (now - still_since_ == kStillCycles) {
    throw Error(ExitCode::kStuck, describe_stuck(still_since_));
  }
}

std::string ClockedMachine::describe_stuck(Cycles now) const {
  std::string text = fmt::format(
      "the machine made no more progress after cycle {}: {} rays in the loop", now, flow_.live());
  for (const auto* unit : units_) {
    const StallCause cause = unit->stalls().cause();
    if (cause == StallCause::kIdle) continue;
    text += fmt::format("; {}: {}", unit->name(), to_string(cause));
  }
  if (!memory_->l2().is_idle()) text += "; l2: requests queued";
  return text;
}

}  // namespace sheaf
