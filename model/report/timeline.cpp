// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

namespace sheaf {
namespace {

constexpr std::array<std::string_view, kNumStallCauses> kCauseNames{"busy", "input", "memory",
                                                                    "blocked", "idle"};

}  // namespace

Timeline::Timeline(const std::filesystem::path& path, const WatchWindow& window)
    : window_(window), writer_(path) {}

void Timeline::attach(const MachineProbes& probes) {
  for (const UnitProbe& probe : probes.units) add_unit(probe);
  for (const LinkProbe& probe : probes.links) add_link(probe);
  for (const LevelProbe& probe : probes.levels) {
    levels_.push_back({writer_.add_counter(probe.name, track_of(probe.unit), "rays"),
                       [value = probe.value](Cycles /*now*/) { return value(); },
                       {}});
  }
  if (probes.dram != nullptr) dram_.emplace(*probes.dram, writer_, window_);
}

void Timeline::add_unit(const UnitProbe& probe) {
  Unit unit;
  unit.probe = probe;
  unit.track = writer_.add_track(probe.name, PerfettoWriter::kTop);
  for (std::uint32_t i = 0; i < probe.contexts; ++i) {
    unit.slots.push_back({writer_.add_track(fmt::format("context {}", i), unit.track)});
  }
  unit.ends_flows = probe.name.starts_with("shader_unit");
  units_.push_back(std::move(unit));
}

void Timeline::add_link(const LinkProbe& probe) {
  const Track parent = track_of(probe.reader);
  const Track depth = writer_.add_counter(probe.name, parent, "messages");
  levels_.push_back({depth, probe.depth, {}});
  if (!probe.from_back) return;
  sources_.push_back(
      {writer_.add_track(fmt::format("packets into {}", probe.name), parent), probe, 0});
}

PerfettoWriter::Track Timeline::track_of(const std::string& unit) const {
  const auto it = std::ranges::find(units_, unit, [](const Unit& u) { return u.probe.name; });
  if (it == units_.end()) throw std::logic_error("timeline: no unit " + unit);
  return it->track;
}

Cycles Timeline::next_observed(Cycles cycle) {
  return cut_at_ ? kNever : window_.next(cycle);
}

void Timeline::observe(Cycles cycle) {
  if (last_ && *last_ + 1 != cycle) close_open(*last_ + 1);
  if (writer_.num_events() >= window_.max_events) {
    cut_at_ = cycle;
    close_open(cycle);
    return;
  }
  for (Source& source : sources_) {
    if (!last_ && cycle != 0) source.written = source.probe.num_written();
    show_new_packets(source, cycle);
  }
  last_ = cycle;
  for (Unit& unit : units_) {
    const UnitState state = unit.probe.state(cycle);
    if (state.cause != unit.cause) show_cause(unit, state.cause, cycle);
    if (state.contexts != unit.held) show_contexts(unit, state.contexts, cycle);
  }
  show_levels(cycle);
}

void Timeline::show_cause(Unit& unit, StallCause cause, Cycles cycle) {
  if (unit.cause != StallCause::kIdle) writer_.end(unit.track, cycle);
  if (cause != StallCause::kIdle) {
    writer_.begin(unit.track, cycle, kCauseNames[static_cast<std::size_t>(cause)]);
  }
  unit.cause = cause;
}

// A context is never given up and taken again in the same cycle.
void Timeline::show_contexts(Unit& unit, std::uint64_t held, Cycles cycle) {
  for (std::uint64_t changed = held ^ unit.held; changed != 0; changed &= changed - 1) {
    const int context = std::countr_zero(changed);
    const Track track = unit.slots[static_cast<std::size_t>(context)].track;
    if (((held >> context) & 1U) == 0) {
      writer_.end(track, cycle);
      continue;
    }
    const RayPacket* packet = unit.probe.packet ? unit.probe.packet(context) : nullptr;
    const std::uint64_t flow = packet != nullptr ? flow_of(packet) : 0;
    writer_.begin(track, cycle, flow != 0 ? fmt::format("packet {}", flow) : "packet", flow,
                  unit.ends_flows);
    if (unit.ends_flows) flows_.erase(packet);
  }
  unit.held = held;
}

void Timeline::show_levels(Cycles cycle) {
  for (Level& level : levels_) {
    const std::uint64_t value = level.value(cycle);
    if (value == level.last) continue;
    writer_.value(level.track, cycle, value);
    level.last = value;
  }
}

// Several may leave the ray cache in a cycle, and some may have been read in the same one.
void Timeline::show_new_packets(Source& source, Cycles cycle) {
  const std::uint64_t written = source.probe.num_written();
  for (std::uint64_t i = written - source.written; i-- > 0;) {
    const RayPacket* packet = source.probe.from_back(i);
    if (packet == nullptr) continue;
    const std::uint64_t flow = flows_[packet] = ++num_flows_;
    writer_.instant(source.track, cycle, fmt::format("packet {}", flow), flow);
  }
  source.written = written;
}

// A packet that was made before the stretch has no number yet.
std::uint64_t Timeline::flow_of(const RayPacket* packet) {
  std::uint64_t& flow = flows_[packet];
  if (flow == 0) flow = ++num_flows_;
  return flow;
}

void Timeline::close_open(Cycles at) {
  for (Unit& unit : units_) {
    show_cause(unit, StallCause::kIdle, at);
    show_contexts(unit, 0, at);
  }
  for (Level& level : levels_) level.last.reset();
  flows_.clear();
  last_.reset();
}

void Timeline::finish(Cycles end) {
  if (last_) close_open(*last_ + 1);
  if (dram_) dram_->finish(end);
  writer_.close();
}

}  // namespace sheaf
