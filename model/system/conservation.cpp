// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/conservation.h"

#include <fmt/format.h>

#include "base/errors.h"
#include "system/clocked_machine.h"
#include "system/machine.h"

namespace sheaf {
void require(bool holds, const std::string& law) {
  if (holds) return;
  throw Error(ExitCode::kBug,
              "bug of the simulator, please report it: conservation violated: " + law);
}

void require_equal(std::uint64_t a, std::uint64_t b, const std::string& law) {
  require(a == b, fmt::format("{}: {} != {}", law, a, b));
}

void check_cache(const std::string& name, const CacheStats& stats) {
  require_equal(stats.num_accesses, stats.num_hits + stats.num_misses + stats.num_merges,
                name + ": accesses = hits + misses + merges");
  require_equal(stats.mshr_occupancy_cycles, stats.sum_miss_latency,
                name + ": mean MSHRs in use = misses per cycle x mean latency");
}

namespace {

void check_sorter(const RayCacheStats& stats) {
  require_equal(stats.num_insertions, stats.num_hits + stats.num_misses,
                "ray cache: insertions = hits + misses");
  require_equal(stats.num_insertions, stats.num_rays(), "ray cache: rays in = rays out");
  require_equal(stats.num_evictions, stats.num_packets_evicted,
                "ray cache: evictions = packets evicted");
}

void check_shading_sorter(const ShaderCacheStats& stats) {
  require_equal(stats.num_rays_in, stats.num_insertions + stats.num_bypassed,
                "shader cache: rays in = insertions + bypassed");
  require_equal(stats.num_insertions, stats.num_hits + stats.num_misses,
                "shader cache: insertions = hits + misses");
  require_equal(stats.num_insertions,
                stats.num_rays_full + stats.num_rays_evicted + stats.num_rays_swept,
                "shader cache: rays in = rays out");
}

template <typename Spill>
void check_spill(const Spill& spill) {
  const SpillStats& stats = spill.stats();
  require(spill.is_idle(), "no ray in the spill unit or its memory at the end");
  require_equal(stats.num_rays, stats.num_rays_kept + stats.num_rays_spilled,
                "spill: rays in = kept + spilled");
  require_equal(stats.num_rays_spilled, stats.num_rays_returned,
                "spill: rays spilled = rays returned");
  require_equal(stats.num_lines_written, stats.num_lines_read, "spill: lines written = lines read");
  require_equal(stats.queue_occupancy_cycles, stats.sum_queue_residence,
                "spill: mean occupancy = throughput x mean residence");
}

template <typename Unit>
void check_stalls(const std::string& name, const Unit& unit, Cycles end) {
  require(unit.stalls().is_ordered(), name + ": stall account never goes back in time");
  require_equal(unit.stalls().total(), end, name + ": stall account sums to all cycles");
}

}  // namespace

template <typename Kind>
void MachineParts<Kind>::check_conservation() const {
  const RayCounts::Entry rays = frame_.rays.total();
  require_equal(rays.spawned, rays.retired, "rays spawned = rays retired");
  require_equal(packets_.num_out(), 0, "no packet in flight at the end");
  require_equal(bundles_.num_out(), 0, "no spawned bundle in flight at the end");
  require_equal(batches_.num_out(), 0, "no film batch in flight at the end");
  if (ray_cache_) check_sorter(ray_cache_->sorter().stats());
  if (shader_cache_) {
    check_shading_sorter(shader_cache_->sorter().stats());
    check_stalls("shader_cache", *shader_cache_, end_);
  }

  std::uint64_t fetched = 0;
  std::uint64_t written = 0;
  const auto cache = [&](const std::string& name, const CacheStats& stats) {
    check_cache(name, stats);
    fetched += stats.bytes_read;
    written += stats.bytes_written;
  };
  for (const auto& unit : traversal_units_) {
    cache(unit->name(), unit->cache().stats());
    check_stalls(unit->name(), *unit, end_);
  }
  for (const auto& unit : intersection_units_) {
    cache(unit->name(), unit->cache().stats());
    check_stalls(unit->name(), *unit, end_);
  }
  for (const auto& unit : shader_units_) {
    cache(unit->name(), unit->attribute_cache().stats());
    if (unit->texture_cache() != nullptr) cache(unit->name(), unit->texture_cache()->stats());
    check_stalls(unit->name(), *unit, end_);
  }
  cache("film", film_->cache().stats());
  check_stalls("film", *film_, end_);
  check_stalls("primary_source", *primary_source_, end_);
  check_stalls("packet_arbiter", *packet_arbiter_, end_);
  if (ray_cache_) check_stalls("ray_cache", *ray_cache_, end_);
  if (spawn_router_) check_stalls("spawn_router", *spawn_router_, end_);
  if (spill_) {
    check_spill(*spill_);
    check_stalls("spill", *spill_, end_);
    fetched += spill_->stats().num_lines_read * spill_->line();
    written += spill_->stats().num_lines_written * spill_->line();
  }
  memory_->check_conservation(fetched, written, end_);
}

template void MachineParts<TimedKind>::check_conservation() const;
template void MachineParts<ClockedKind>::check_conservation() const;

}  // namespace sheaf
