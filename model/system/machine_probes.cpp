// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/machine.h"
#include "system/machine_links.h"

namespace sheaf {
namespace {

template <typename Unit>
UnitProbe probe_contexts(const Unit& unit, const UnitSpec& spec) {
  const auto state = [&unit](Cycles now) {
    return UnitState{unit.cause_at(now), unit.held_contexts(), unit.port_taken_at(now)};
  };
  return {unit.name(), spec.contexts, state, {}};
}

template <typename Unit>
UnitProbe probe_stalls(const Unit& unit) {
  const auto state = [&unit](Cycles /*now*/) {
    return UnitState{.cause = unit.stalls().cause(),
                     .issuing = unit.stalls().cause() == StallCause::kBusy};
  };
  return {unit.name(), 0, state, {}};
}

template <typename T>
LinkProbe probe_link(const TimedChannel<T>& link, const char* reader) {
  return {link.name(), reader, [&link](Cycles now) { return link.num_held(now); }, {}, {}};
}

LinkProbe probe_packets(const PacketChannel& link, const char* reader) {
  LinkProbe probe = probe_link(link, reader);
  probe.num_written = [&link] { return link.num_written(); };
  probe.from_back = [&link](std::size_t i) {
    return i < link.size() ? static_cast<const RayPacket*>(link.from_back(i)) : nullptr;
  };
  return probe;
}

}  // namespace

void Machine::observe(MachineObserver& observer) {
  observer.attach(probes());
  domain_.observe(observer);
  observers_.push_back(&observer);
}

MachineProbes Machine::probes() {
  MachineProbes probes;
  probe_units(probes);
  probe_links(probes);
  probes.levels.push_back(
      {"rays_in_loop", primary_source_->name(), [this] { return flow_.live(); }});
  if (ray_cache_) {
    probes.levels.push_back({"rays_in_cells", ray_cache_->name(),
                             [this] { return ray_cache_->sorter().num_waiting(); }});
  }
  if (shader_cache_) {
    probes.levels.push_back({"rays_in_cells", shader_cache_->name(),
                             [this] { return shader_cache_->sorter().num_waiting(); }});
  }
  probes.dram = dynamic_cast<BankedDram*>(&memory_->dram());
  return probes;
}

void Machine::probe_units(MachineProbes& probes) const {
  auto& units = probes.units;
  units.push_back(probe_stalls(*primary_source_));
  if (spill_) units.push_back(probe_stalls(*spill_));
  if (ray_cache_) units.push_back(probe_stalls(*ray_cache_));
  if (spawn_router_) units.push_back(probe_stalls(*spawn_router_));
  units.push_back(probe_stalls(*packet_arbiter_));
  for (const auto& unit : traversal_units_) {
    units.push_back(probe_contexts(*unit, config_.traversal_unit));
    units.back().packet = [&unit](int context) { return unit->packet(context); };
  }
  for (const auto& unit : intersection_units_) {
    units.push_back(probe_contexts(*unit, config_.intersection_unit));
    units.back().packet = [this, &unit](int context) {
      const LeafJob& job = unit->job(context);
      return traversal_units_[job.unit]->packet(job.context);
    };
  }
  if (shader_cache_) units.push_back(probe_stalls(*shader_cache_));
  for (const auto& unit : shader_units_) {
    units.push_back(probe_contexts(*unit, config_.shader_unit));
    // Behind a shader cache packets are others than those that were traced.
    if (!shader_cache_) {
      units.back().packet = [&unit](int context) { return unit->packet(context); };
    }
  }
  units.push_back(probe_stalls(*film_));
}

void Machine::probe_links(MachineProbes& probes) const {
  auto& links = probes.links;
  const auto& all = links_;
  links.push_back(probe_packets(*all.source_to_arbiter, packet_arbiter_->name()));
  if (all.packet_fifo) links.push_back(probe_packets(*all.packet_fifo, packet_arbiter_->name()));
  if (all.spawned_rays) {
    const char* const regrouper = ray_cache_ ? ray_cache_->name() : spawn_router_->name();
    links.push_back(probe_link(*all.spawned_rays, spill_ ? spill_->name() : regrouper));
    if (spill_) links.push_back(probe_link(*all.spill_to_regrouper, regrouper));
  }
  for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
    links.push_back(probe_link(*all.arbiter_to_traversal[i], traversal_units_[i]->name()));
    links.push_back(probe_link(*all.intersection_to_traversal[i], traversal_units_[i]->name()));
  }
  // One per pair of a reader and a traversal unit, the readers one after the other.
  for (std::size_t i = 0; i < all.traversal_to_intersection.size(); ++i) {
    links.push_back(probe_link(*all.traversal_to_intersection[i],
                               intersection_units_[i / traversal_units_.size()]->name()));
  }
  for (std::size_t i = 0; i < all.traversal_to_shader.size(); ++i) {
    links.push_back(probe_link(*all.traversal_to_shader[i],
                               shader_units_[i / traversal_units_.size()]->name()));
  }
  for (const auto& link : all.traversal_to_shader_cache) {
    links.push_back(probe_link(*link, shader_cache_->name()));
  }
  for (std::size_t i = 0; i < all.shader_cache_to_shader.size(); ++i) {
    links.push_back(probe_link(*all.shader_cache_to_shader[i], shader_units_[i]->name()));
  }
  links.push_back(probe_link(*all.shader_to_film, film_->name()));
}

}  // namespace sheaf
