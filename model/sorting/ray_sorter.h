// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <memory>
#include <vector>

#include "base/units.h"
#include "config/config.h"
#include "geometry/ray.h"
#include "sorting/heuristic.h"
#include "stats/counters.h"
#include "stats/histogram.h"
#include "traversal/packet_pool.h"

namespace sheaf {

/// Why a packet left the ray cache.
enum class Departure : std::uint8_t {
  kFull,
  kEvicted,
  kTimedOut,
  kSweptTile,
  kSweptFrame,
  kSweptStall
};
inline constexpr int kNumDepartures = 6;

// Every insertion is a hit or a miss; every miss that finds no free cell is also an eviction.
#define SHEAF_RAY_CACHE_COUNTERS(X)                                                             \
  X(num_insertions, "rays", "Rays that entered the ray cache")                                  \
  X(num_hits, "rays", "Rays whose cell was open already")                                       \
  X(num_misses, "rays", "Rays for which a cell was opened")                                     \
  X(num_evictions, "cells", "Cells closed to make room for another")                            \
  X(num_packets_full, "packets", "Packets that left because their cell was full")               \
  X(num_packets_evicted, "packets", "Packets that left because their cell was evicted")         \
  X(num_packets_timed_out, "packets", "Packets that left because their cell was open too long") \
  X(num_packets_swept_tile, "packets", "Packets swept out at the end of a tile")                \
  X(num_packets_swept_frame, "packets", "Packets swept out at the end of the frame")            \
  X(num_packets_swept_stall, "packets",                                                         \
    "Packets swept out because nothing else could move before they left")                       \
  X(num_rays_full, "rays", "Rays in packets that left full")                                    \
  X(num_rays_evicted, "rays", "Rays in packets that left evicted")                              \
  X(num_rays_timed_out, "rays", "Rays in packets that left timed out")                          \
  X(num_rays_swept_tile, "rays", "Rays in packets swept at the end of a tile")                  \
  X(num_rays_swept_frame, "rays", "Rays in packets swept at the end of the frame")              \
  X(num_rays_swept_stall, "rays", "Rays in packets swept because nothing else could move")      \
  X(sum_cell_residence, "cycles", "Cell residence times, first ray to departure, summed")       \
  X(max_cell_residence, "cycles", "Longest residence of a cell")                                \
  X(max_rays, "rays", "Most rays waiting in cells at a time")                                   \
  X(max_open_cells, "cells", "Most cells open at a time")                                       \
  X(max_held, "rays", "Most rays that breadth-first order held back at a time")
SHEAF_STATS(RayCacheCounters, SHEAF_RAY_CACHE_COUNTERS);

struct RayCacheStats : RayCacheCounters {
  /// Packets and rays that left, for whatever reason.
  [[nodiscard]] std::uint64_t num_packets() const {
    return num_packets_full + num_packets_evicted + num_packets_timed_out + num_packets_swept_tile +
           num_packets_swept_frame + num_packets_swept_stall;
  }
  [[nodiscard]] std::uint64_t num_rays() const {
    return num_rays_full + num_rays_evicted + num_rays_timed_out + num_rays_swept_tile +
           num_rays_swept_frame + num_rays_swept_stall;
  }
};

/// Gathers rays into packets. Knows cycles only as numbers it is given: 0 where time is not
/// simulated.
class RaySorter {
 public:
  explicit RaySorter(PacketPool& pool) : pool_(pool) {}
  virtual ~RaySorter() = default;

  /// Takes a ray in; packets that leave because of it are appended to `departures`.
  virtual void insert(const Ray& ray, Cycles now, std::vector<RayPacket*>& departures) = 0;
  /// Packets of all rays that wait, emptying the sorter.
  virtual void sweep(Departure why, Cycles now, std::vector<RayPacket*>& departures) = 0;
  /// Packets of the cells opened at or before `opened_by`.
  virtual void time_out(Cycles opened_by, Cycles now, std::vector<RayPacket*>& departures) = 0;
  /// When the cell that has been open longest was opened, or kNever.
  [[nodiscard]] virtual Cycles oldest_opening() const = 0;

  [[nodiscard]] std::size_t num_waiting() const { return num_waiting_; }
  [[nodiscard]] const RayCacheStats& stats() const { return stats_; }
  /// Rays in a leaving packet, 0 to 64.
  [[nodiscard]] const FillHistogram& fill() const { return fill_; }

 protected:
  void count_departure(Departure why, const RayPacket& packet, Cycles opened, Cycles now);

  PacketPool& pool_;
  RayCacheStats stats_;
  FillHistogram fill_;
  std::size_t num_waiting_ = 0;
};

struct SorterOptions {
  HeuristicChoice heuristic;
  std::uint32_t num_cells = 8;
  VictimPolicy victim = VictimPolicy::kFullest;
  bool group_by_kind = false;
  std::uint32_t resident_voxels = 0;
  RayOrder order = RayOrder::kArrival;
};

/// A sorter for any heuristic; for none, which does not sort, only in breadth-first order.
[[nodiscard]] std::unique_ptr<RaySorter> make_sorter(const SorterOptions& options,
                                                     const Box& scene_bounds, PacketPool& pool);

}  // namespace sheaf
