// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/ray_sorter.h"

#include <algorithm>

#include "sorting/breadth_first.h"
#include "sorting/cell_sorter.h"
#include "sorting/grid_sorter.h"
#include "sorting/opos.h"

namespace sheaf {

void RaySorter::count_departure(Departure why, const RayPacket& packet, Cycles opened, Cycles now) {
  const auto rays = static_cast<std::uint64_t>(std::popcount(packet.active));
  struct Pair {
    std::uint64_t* packets;
    std::uint64_t* rays;
  };
  const Pair counters[kNumDepartures] = {
      {&stats_.num_packets_full, &stats_.num_rays_full},
      {&stats_.num_packets_evicted, &stats_.num_rays_evicted},
      {&stats_.num_packets_timed_out, &stats_.num_rays_timed_out},
      {&stats_.num_packets_swept_tile, &stats_.num_rays_swept_tile},
      {&stats_.num_packets_swept_frame, &stats_.num_rays_swept_frame},
      {&stats_.num_packets_swept_stall, &stats_.num_rays_swept_stall},
  };
  ++*counters[static_cast<std::size_t>(why)].packets;
  *counters[static_cast<std::size_t>(why)].rays += rays;
  fill_.record(rays);
  stats_.sum_cell_residence += now - opened;
  stats_.max_cell_residence = std::max(stats_.max_cell_residence, now - opened);
  num_waiting_ -= rays;
}

namespace {

std::unique_ptr<RaySorter> make_sorter_of_arrivals(const SorterOptions& options,
                                                   const Box& scene_bounds, PacketPool& pool) {
  if (options.heuristic.kind == HeuristicChoice::Kind::kOpos) {
    return std::make_unique<OposSorter>(options.group_by_kind, pool);
  }
  if (options.heuristic.kind == HeuristicChoice::Kind::kGrid) {
    return std::make_unique<GridSorter>(options, scene_bounds, pool);
  }
  return std::make_unique<CellSorter>(options, scene_bounds, pool);
}

}  // namespace

std::unique_ptr<RaySorter> make_sorter(const SorterOptions& options, const Box& scene_bounds,
                                       PacketPool& pool) {
  auto sorter = make_sorter_of_arrivals(options, scene_bounds, pool);
  if (options.order == RayOrder::kArrival) return sorter;
  return std::make_unique<BreadthFirstSorter>(std::move(sorter), pool);
}

}  // namespace sheaf
