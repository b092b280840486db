// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sorting/ray_sorter.h"

namespace sheaf {

/// The ray cache of the paper: a fixed number of cells, each a packet being filled.
class CellSorter final : public RaySorter {
 public:
  CellSorter(const SorterOptions& options, const Box& scene_bounds, PacketPool& pool);

  void insert(const Ray& ray, Cycles now, std::vector<RayPacket*>& departures) override;
  void sweep(Departure why, Cycles now, std::vector<RayPacket*>& departures) override;
  void time_out(Cycles opened_by, Cycles now, std::vector<RayPacket*>& departures) override;
  [[nodiscard]] Cycles oldest_opening() const override;

 private:
  struct Cell {
    RayPacket* packet = nullptr;  ///< null: not open
    int num_rays = 0;
    Cycles opened = 0;
    std::uint64_t opening = 0;   ///< rank of the opening, for the victim policies
    std::uint64_t last_use = 0;  ///< rank of the last insertion
    std::size_t group = 0;       ///< of kinds of rays, if they are kept apart
  };

  [[nodiscard]] std::uint32_t open_cell(const Ray& ray, std::size_t group, Cycles now,
                                        std::vector<RayPacket*>& departures);
  [[nodiscard]] std::uint32_t choose_victim() const;
  void close(std::uint32_t index, Departure why, Cycles now, std::vector<RayPacket*>& departures);

  VictimPolicy victim_;
  /// One for all rays, or one a group of kinds; they share the cells.
  std::vector<std::unique_ptr<Heuristic>> heuristics_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> free_;
  std::uint64_t rank_ = 0;
};

}  // namespace sheaf
