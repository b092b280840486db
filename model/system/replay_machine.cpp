// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/replay_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/errors.h"
#include "system/conservation.h"
#include "system/reported_values.h"

namespace sheaf {
namespace {

/// The parameters of a recorded cache; null for a group that there is not.
const CacheSpec* find_cache(const Config& config, std::string_view group) {
  const std::array<std::pair<std::string_view, const CacheSpec*>, 5> known{
      {{"node_cache", &config.node_cache},
       {"triangle_cache", &config.triangle_cache},
       {"attribute_cache", &config.attribute_cache},
       {"texture_cache", &config.texture_cache},
       {"film_cache", &config.film_cache}}};
  for (const auto& [name, spec] : known) {
    if (name == group) return spec;
  }
  return nullptr;
}

}  // namespace

ReplayMachine::ReplayMachine(const Config& config, TraceReader& reader,
                             const TraceMetadata& metadata, ReplayMode mode)
    : config_(config),
      metadata_(metadata),
      domain_("clock_domain", clock_period(config)),
      memory_(config, domain_),
      schedule_(metadata.memory, domain_) {
  build(reader, mode);
}

void ReplayMachine::build(TraceReader& reader, ReplayMode mode) {
  const MemoryLayout& layout = metadata_.memory;
  const auto add_caches = [&](std::size_t stream, auto& unit) {
    for (const MemoryTraceCache& cache : layout.streams[stream].caches) {
      const CacheSpec* spec = find_cache(config_, cache.group);
      if (spec == nullptr) reader.refuse(0, "its metadata name a cache that there is not");
      const std::uint16_t requester = memory_.add_requester(*spec);
      unit.add_cache(*spec, memory_.requests(), requester, memory_.lines(requester));
    }
  };
  for (std::size_t i = 0; i < layout.streams.size(); ++i) {
    const std::string name = fmt::format("unit{}", i);
    MemoryStream records(reader, layout, i);
    if (mode == ReplayMode::kFixed) {
      fixed_.push_back(
          std::make_unique<FixedUnit>(name.c_str(), layout, std::move(records), domain_));
      add_caches(i, *fixed_.back());
    } else {
      elastic_.push_back(
          std::make_unique<ElasticUnit>(name.c_str(), layout, i, schedule_, domain_));
      schedule_.add(*elastic_.back(), std::move(records));
      add_caches(i, *elastic_.back());
    }
  }
  // Whoever is done may let a chain of any other begin, or answer it, a cycle later.
  for (const auto& from : elastic_) {
    for (const auto& to : elastic_) domain_.declare_link(from->agent(), to->agent(), 1);
    domain_.declare_link(schedule_.agent(), from->agent(), 1);
  }
}

bool ReplayMachine::run(const Monitor& monitor) {
  domain_.set_monitor(monitor);
  if (config_.run.max_cycles != 0) domain_.set_end(config_.run.max_cycles);
  if (!elastic_.empty()) schedule_.begin();
  domain_.run();
  end_ = domain_.latest() + 1;
  memory_.dram().finish(end_);
  if (!domain_.ran_dry()) return false;
  if (!is_finished()) {
    throw Error(ExitCode::kTrace,
                fmt::format("the trace waits after cycle {} for something that never comes; it was "
                            "not written by Sheaf as it is",
                            domain_.now()));
  }
  check_conservation();
  return true;
}

bool ReplayMachine::is_finished() const {
  if (elastic_.empty()) {
    return std::ranges::all_of(fixed_, [](const auto& unit) { return unit->is_finished(); });
  }
  return schedule_.all_done() &&
         std::ranges::all_of(elastic_, [](const auto& unit) { return unit->is_quiet(); });
}

const PrivateCache& ReplayMachine::cache(std::size_t stream, std::size_t i) const {
  return elastic_.empty() ? fixed_[stream]->cache(i) : elastic_[stream]->cache(i);
}

void ReplayMachine::check_conservation() const {
  Bytes fetched = 0;
  Bytes written = 0;
  for (std::size_t stream = 0; stream < metadata_.memory.streams.size(); ++stream) {
    for (std::size_t i = 0; i < metadata_.memory.streams[stream].caches.size(); ++i) {
      const CacheStats& stats = cache(stream, i).stats();
      check_cache(metadata_.memory.streams[stream].name, stats);
      fetched += stats.bytes_read;
      written += stats.bytes_written;
    }
  }
  memory_.check_conservation(fetched, written, end_);
}

void ReplayMachine::report(StatsTree& stats) const {
  stats.add("system", SystemValues::cycles, end_);
  stats.add_real("system", SystemValues::seconds,
                 static_cast<double>(end_) / config_.clock.frequency);
  stats.add("system", SystemValues::num_wakes, domain_.num_wakes());
  for (std::size_t stream = 0; stream < metadata_.memory.streams.size(); ++stream) {
    const MemoryTraceStream& unit = metadata_.memory.streams[stream];
    for (std::size_t i = 0; i < unit.caches.size(); ++i) {
      report_cache(fmt::format("system.{}.{}", unit.name, unit.caches[i].name), cache(stream, i),
                   stats);
    }
  }
  memory_.report(end_, metadata_.num_rays, false, stats);
}

}  // namespace sheaf
