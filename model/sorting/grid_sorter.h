// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sorting/ray_sorter.h"
#include "sorting/voxel_grid.h"

namespace sheaf {

/// grid(x): rays wait in the queue of the voxel, of x³, in which they start. When as many wait as
/// the ray cache's cells hold, one voxel is scheduled and all its rays leave as packets: of the
/// voxels scheduled last, whose geometry is taken to be in the caches, the latest with a full
/// packet, else the voxel with most rays (Pharr, Kolb, Gershbein and Hanrahan, "Rendering complex
/// scenes with memory-coherent ray tracing", 1997; Navrátil, Fussell, Lin and Mark, "Dynamic ray
/// scheduling to improve ray coherence and bandwidth utilization", 2007). A sweep schedules voxel
/// after voxel.
class GridSorter final : public RaySorter {
 public:
  GridSorter(const SorterOptions& options, const Box& scene_bounds, PacketPool& pool);

  void insert(const Ray& ray, Cycles now, std::vector<RayPacket*>& departures) override;
  void sweep(Departure why, Cycles now, std::vector<RayPacket*>& departures) override;
  void time_out(Cycles opened_by, Cycles now, std::vector<RayPacket*>& departures) override;
  [[nodiscard]] Cycles oldest_opening() const override;

 private:
  struct Waiting {
    Ray ray;
    Cycles arrival = 0;
  };
  using Queue = std::vector<Waiting>;

  /// The next queue to schedule; a resident one only if it holds `least` rays.
  [[nodiscard]] std::uint32_t choose(std::size_t least) const;
  void schedule(std::uint32_t index, Departure why, Cycles now,
                std::vector<RayPacket*>& departures);
  void make_resident(std::uint32_t voxel);

  const VoxelGrid grid_;
  const bool by_kind_;
  const std::size_t packet_size_;
  const std::size_t capacity_;  ///< rays
  const std::size_t num_resident_;
  std::vector<Queue> queues_;             ///< one a voxel, or one a voxel and kind
  std::vector<std::uint32_t> occupied_;   ///< queues that hold a ray, in order of their first
  std::vector<std::uint32_t> residents_;  ///< voxels scheduled last, the latest first
};

}  // namespace sheaf
