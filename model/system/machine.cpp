// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/machine.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.h"
#include "system/pipeline_parts.h"

namespace sheaf {
namespace {

// Links that another rule keeps from filling up: credits for contexts, or flow control for spawned
// rays.
constexpr std::size_t kNeverFull = PacketChannel::kUnbounded;

// From the fastest path through link, unit and link that nothing holds up.
AnswerTimes answer_times(const Config& config) {
  const UnitSpec& unit = config.intersection_unit;
  const Cycles hit = config.triangle_cache.hit_latency;
  const Cycles slots = (config.packet.size + unit.lanes - 1) / unit.lanes;
  return {.line = 2 * config.link.memory_latency,
          .leaf_fixed = 2 * config.link.latency + hit,
          .leaf_test = slots * unit.initiation_interval - 1 + hit + unit.latency};
}

}  // namespace

Machine::Machine(const Config& config, const BuildPlan& plan, const PreparedScene& scene,
                 Frame& frame, const RunHooks& hooks)
    : MachineParts(config, plan, scene, frame, hooks),
      domain_("clock_domain", clock_period(config)) {
  if (config_.run.fidelity == Fidelity::kDecoupled) domain_.set_quantum(config_.run.quantum);
  memory_ = std::make_unique<MemorySystem>(config_, domain_);
  build_units();
  if (plan_.secondary_rays) build_regrouper();
  connect();
  flow_.declare_links();
  if (hooks_.memory != nullptr) record_memory(*hooks_.memory);
}

Machine::~Machine() = default;

void Machine::build_units() {
  const int packet_size = static_cast<int>(config_.packet.size);
  const TracedScene traced{scene_.tree, scene_.triangles, scene_.memory,
                           scheme_of(config_.traversal_scheme)};
  ShadingSource& shading = hooks_.shading != nullptr ? *hooks_.shading : shader_;
  const ShadedScene shaded{scene_.scene, shading,  scene_.memory, packets_,
                           bundles_,     batches_, frame_.rays,   flow_};
  const AnswerTimes times = answer_times(config_);
  const TileOrder order(config_.image.width, config_.image.height, config_.flow.tile_size,
                        packet_size, hooks_.tile_choice);
  TimedOut<LineRequest>& memory = memory_->requests();

  primary_source_ = std::make_unique<PrimarySource>(
      "primary_source", config_.primary_source, config_.image, order, scene_.scene.camera, packets_,
      frame_.rays, flow_, domain_, hooks_.tiles);
  packet_arbiter_ = std::make_unique<PacketArbiter>("packet_arbiter", config_.packet_arbiter,
                                                    config_.traversal_unit.count,
                                                    config_.traversal_unit.contexts, domain_);
  for (std::uint32_t i = 0; i < config_.traversal_unit.count; ++i) {
    const std::uint16_t requester = memory_->add_requester(config_.node_cache);
    traversal_units_.push_back(std::make_unique<TraversalUnit>(
        fmt::format("traversal_unit{}", i).c_str(), config_.traversal_unit, packet_size,
        config_.node_cache, traced, times, &frame_.heat, domain_, static_cast<std::uint16_t>(i),
        memory, requester));
    traversal_units_.back()->in_lines(memory_->lines(requester));
  }
  for (std::uint32_t i = 0; i < config_.intersection_unit.count; ++i) {
    const std::uint16_t requester = memory_->add_requester(config_.triangle_cache);
    intersection_units_.push_back(std::make_unique<IntersectionUnit>(
        fmt::format("intersection_unit{}", i).c_str(), config_.intersection_unit, packet_size,
        config_.triangle_cache, traced, times, domain_, memory, requester));
    intersection_units_.back()->in_lines(memory_->lines(requester));
  }
  for (std::uint32_t i = 0; i < config_.shader_unit.count; ++i) {
    const std::uint16_t attributes = memory_->add_requester(config_.attribute_cache);
    const std::uint16_t textures =
        plan_.texture_cache ? memory_->add_requester(config_.texture_cache) : attributes;
    shader_units_.push_back(std::make_unique<ShaderUnit>(
        fmt::format("shader_unit{}", i).c_str(), config_.shader_unit, packet_size,
        config_.attribute_cache, plan_.texture_cache ? &config_.texture_cache : nullptr, shaded,
        domain_, memory, attributes, textures));
    shader_units_.back()->in_attribute_lines(memory_->lines(attributes));
    if (plan_.texture_cache) {
      shader_units_.back()->in_texture_lines(memory_->lines(textures));
    }
  }
  if (plan_.shader_cache) {
    shader_cache_ = std::make_unique<ShaderCacheUnit>("shader_cache", config_.shader_cache,
                                                      scene_.scene, packets_, flow_, domain_);
  }
  const std::uint16_t film = memory_->add_requester(config_.film_cache);
  film_ = std::make_unique<FilmUnit>("film", config_.film_cache, *frame_.film, scene_.memory,
                                     batches_, flow_, domain_, memory, film);
  film_->in_lines(memory_->lines(film));
}

void Machine::build_regrouper() {
  links_.packet_fifo = std::make_unique<PacketChannel>(
      "packet_fifo",
      PacketChannel::Spec{.capacity = config_.packet_fifo.depth,
                          .latency = config_.packet_fifo.latency +
                                     (plan_.ray_cache ? config_.ray_cache.latency : 0)});
  links_.spawned_rays = std::make_unique<TimedChannel<SpawnBundle*>>(
      "spawned_rays",
      TimedChannel<SpawnBundle*>::Spec{
          .capacity = config_.flow.control == FlowPolicy::kSpill ? config_.link.depth : kNeverFull,
          .latency = config_.link.latency});
  if (config_.flow.control == FlowPolicy::kSpill) build_spill();
  auto& bundles = links_.spill_to_regrouper ? *links_.spill_to_regrouper : *links_.spawned_rays;
  if (plan_.ray_cache) {
    const SorterOptions options = sorter_options(config_, plan_, scene_.scene.bounds);
    ray_cache_ = std::make_unique<RayCacheUnit>("ray_cache", config_.ray_cache,
                                                make_sorter(options, scene_.scene.bounds, packets_),
                                                bundles_, flow_, domain_);
    ray_cache_->in_bundles(bundles);
    ray_cache_->out_packets(*links_.packet_fifo);
  } else {
    spawn_router_ = std::make_unique<SpawnRouter>("spawn_router", packets_, bundles_, domain_);
    spawn_router_->in_bundles(bundles);
    spawn_router_->out_packets(*links_.packet_fifo);
  }
}

// The queue that spills stands right before whoever takes the rays in.
void Machine::build_spill() {
  links_.spill_to_regrouper = std::make_unique<TimedChannel<SpawnBundle*>>(
      "spill_to_regrouper", TimedChannel<SpawnBundle*>::Spec{.capacity = 2, .latency = 1});
  const Bytes line = config_.l2.line / config_.l2.sectors;
  const std::uint16_t requester = memory_->add_requester(line);
  spill_ = std::make_unique<SpillUnit>(
      "spill",
      SpillUnit::Spec{.queue = config_.flow.spill_queue,
                      .line = line,
                      .base = scene_.memory.region(DataKind::kSpilledRay).base,
                      .requester = requester},
      memory_->requests(), domain_);
  spill_->in_bundles(*links_.spawned_rays);
  spill_->out_bundles(*links_.spill_to_regrouper);
  spill_->in_lines(memory_->lines(requester));
}

void Machine::connect() {
  const Cycles latency = config_.link.latency;
  const std::size_t depth = config_.link.depth;
  auto& links = links_;
  const auto number = [](const char* name, std::size_t i) { return fmt::format("{}{}", name, i); };

  links.source_to_arbiter = std::make_unique<PacketChannel>(
      "source_to_arbiter", PacketChannel::Spec{.capacity = depth, .latency = latency});
  primary_source_->out_packets(*links.source_to_arbiter);
  packet_arbiter_->in_primary(*links.source_to_arbiter);
  if (plan_.secondary_rays) packet_arbiter_->in_secondary(*links.packet_fifo);

  links.traversal_to_arbiter = std::make_unique<TimedChannel<ContextFree>>(
      "traversal_to_arbiter",
      TimedChannel<ContextFree>::Spec{.capacity = kNeverFull, .latency = latency, .interval = 0});
  packet_arbiter_->in_free(*links.traversal_to_arbiter);

  for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
    TraversalUnit& unit = *traversal_units_[i];
    links.arbiter_to_traversal.push_back(std::make_unique<PacketChannel>(
        number("arbiter_to_traversal", i).c_str(),
        PacketChannel::Spec{.capacity = kNeverFull, .latency = latency}));
    packet_arbiter_->out_packets(*links.arbiter_to_traversal.back());
    unit.in_packets(*links.arbiter_to_traversal.back());
    links.intersection_to_traversal.push_back(std::make_unique<TimedChannel<LeafDone>>(
        number("intersection_to_traversal", i).c_str(),
        TimedChannel<LeafDone>::Spec{.capacity = kNeverFull, .latency = latency, .interval = 0}));
    unit.in_done(*links.intersection_to_traversal.back());
    unit.out_free(*links.traversal_to_arbiter);
  }
  for (auto& unit : intersection_units_) {
    for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
      links.traversal_to_intersection.push_back(std::make_unique<TimedChannel<LeafJob>>(
          fmt::format("traversal{}_to_{}", i, unit->name()).c_str(),
          TimedChannel<LeafJob>::Spec{.capacity = depth, .latency = latency}));
      unit->in_jobs(*links.traversal_to_intersection.back());
      traversal_units_[i]->out_jobs(*links.traversal_to_intersection.back());
      unit->out_done(*links.intersection_to_traversal[i]);
    }
  }
  links.shader_to_film = std::make_unique<TimedChannel<FilmBatch*>>(
      "shader_to_film", TimedChannel<FilmBatch*>::Spec{.capacity = depth, .latency = latency});
  film_->in_batches(*links.shader_to_film);
  for (auto& shader : shader_units_) {
    ShaderUnit& unit = *shader;
    unit.out_film(*links.shader_to_film);
    if (plan_.secondary_rays) unit.out_bundles(*links.spawned_rays);
  }
  if (shader_cache_) {
    connect_shader_cache();
  } else {
    connect_shaders();
  }
}

void Machine::connect_shaders() {
  for (auto& shader : shader_units_) {
    for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
      links_.traversal_to_shader.push_back(std::make_unique<PacketChannel>(
          fmt::format("traversal{}_to_{}", i, shader->name()).c_str(),
          PacketChannel::Spec{.capacity = config_.link.depth, .latency = config_.link.latency}));
      shader->in_packets(*links_.traversal_to_shader.back());
      traversal_units_[i]->out_packets(*links_.traversal_to_shader.back());
    }
  }
}

void Machine::connect_shader_cache() {
  const PacketChannel::Spec spec{.capacity = config_.link.depth, .latency = config_.link.latency};
  for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
    links_.traversal_to_shader_cache.push_back(std::make_unique<PacketChannel>(
        fmt::format("traversal{}_to_shader_cache", i).c_str(), spec));
    traversal_units_[i]->out_packets(*links_.traversal_to_shader_cache.back());
    shader_cache_->in_packets(*links_.traversal_to_shader_cache.back());
  }
  for (auto& shader : shader_units_) {
    links_.shader_cache_to_shader.push_back(std::make_unique<PacketChannel>(
        fmt::format("shader_cache_to_{}", shader->name()).c_str(), spec));
    shader_cache_->out_packets(*links_.shader_cache_to_shader.back());
    shader->in_packets(*links_.shader_cache_to_shader.back());
  }
}

bool Machine::run(const Monitor& monitor) {
  if (monitor) {
    domain_.set_monitor([&](Cycles now) { return monitor(primary_source_->progress(), now); });
  }
  if (config_.run.max_cycles != 0) domain_.set_end(config_.run.max_cycles);
  domain_.run();
  const bool cut = !domain_.ran_dry() && !domain_.stopped();
  end_ = cut ? config_.run.max_cycles : domain_.latest() + 1;
  complete_ = domain_.ran_dry() && flow_.finished();
  num_wakes_ = domain_.num_wakes();
  for (MachineObserver* observer : observers_) observer->finish(end_);
  finish_accounts(end_);
  memory_->dram().finish(end_);
  if (domain_.ran_dry()) {
    if (!flow_.finished()) throw Error(ExitCode::kStuck, describe_stuck());
    check_conservation();
  }
  return complete_;
}

std::string Machine::describe_stuck() const {
  std::string text =
      fmt::format("the machine made no more progress after cycle {}: {} rays in the loop",
                  domain_.now(), flow_.live());
  const auto add = [&](const Agent* agent) {
    if (agent == nullptr) return;
    const std::string reason = agent->stuck_reason();
    if (!reason.empty()) text += "; " + reason;
  };
  for (const auto& unit : traversal_units_) add(unit.get());
  for (const auto& unit : intersection_units_) add(unit.get());
  for (const auto& unit : shader_units_) add(unit.get());
  add(shader_cache_.get());
  add(primary_source_.get());
  add(packet_arbiter_.get());
  add(ray_cache_.get());
  add(spawn_router_.get());
  add(spill_.get());
  add(film_.get());
  add(&memory_->l2());
  if (links_.packet_fifo && links_.packet_fifo->size() != 0) {
    text += fmt::format("; packet_fifo: {} packets", links_.packet_fifo->size());
  }
  return text;
}

}  // namespace sheaf
