// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/cell_sorter.h"

#include <algorithm>

#include "sorting/kind_group.h"

namespace sheaf {

CellSorter::CellSorter(const SorterOptions& options, const Box& scene_bounds, PacketPool& pool)
    : RaySorter(pool), victim_(options.victim), cells_(options.num_cells) {
  heuristics_.resize(options.group_by_kind ? kNumKindGroups : 1);
  for (auto& heuristic : heuristics_) {
    heuristic = make_heuristic(options.heuristic, options.num_cells, scene_bounds);
  }
  for (std::uint32_t cell = options.num_cells; cell-- > 0;) free_.push_back(cell);
}

void CellSorter::insert(const Ray& ray, Cycles now, std::vector<RayPacket*>& departures) {
  ++stats_.num_insertions;
  const std::size_t group = heuristics_.size() > 1 ? kind_group(ray.tag.kind) : 0;
  std::uint32_t index = heuristics_[group]->find(ray.origin, ray.direction);
  if (index != kNoCell) {
    ++stats_.num_hits;
  } else {
    ++stats_.num_misses;
    index = open_cell(ray, group, now, departures);
  }
  Cell& cell = cells_[index];
  cell.packet->put(cell.num_rays++, ray);
  cell.last_use = ++rank_;
  stats_.max_rays = std::max<std::uint64_t>(stats_.max_rays, ++num_waiting_);
  if (cell.num_rays == cell.packet->size) close(index, Departure::kFull, now, departures);
}

std::uint32_t CellSorter::open_cell(const Ray& ray, std::size_t group, Cycles now,
                                    std::vector<RayPacket*>& departures) {
  if (free_.empty()) {
    ++stats_.num_evictions;
    close(choose_victim(), Departure::kEvicted, now, departures);
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  heuristics_[group]->open(index, ray.origin, ray.direction);
  cells_[index] = {pool_.acquire(), 0, now, ++rank_, rank_, group};
  stats_.max_open_cells =
      std::max<std::uint64_t>(stats_.max_open_cells, cells_.size() - free_.size());
  return index;
}

std::uint32_t CellSorter::choose_victim() const {
  // Called only when every cell is open. Of equally full cells the one opened first goes.
  const auto better = [this](const Cell& a, const Cell& b) {
    switch (victim_) {
      case VictimPolicy::kFullest:
        return a.num_rays != b.num_rays ? a.num_rays > b.num_rays : a.opening < b.opening;
      case VictimPolicy::kOldest:
        return a.opening < b.opening;
      case VictimPolicy::kLru:
        return a.last_use < b.last_use;
    }
    return false;
  };
  return static_cast<std::uint32_t>(std::min_element(cells_.begin(), cells_.end(), better) -
                                    cells_.begin());
}

void CellSorter::close(std::uint32_t index, Departure why, Cycles now,
                       std::vector<RayPacket*>& departures) {
  Cell& cell = cells_[index];
  count_departure(why, *cell.packet, cell.opened, now);
  departures.push_back(cell.packet);
  heuristics_[cell.group]->close(index);
  cell = {};
  free_.push_back(index);
}

void CellSorter::sweep(Departure why, Cycles now, std::vector<RayPacket*>& departures) {
  for (std::uint32_t index = 0; index < cells_.size(); ++index) {
    if (cells_[index].packet != nullptr) close(index, why, now, departures);
  }
}

void CellSorter::time_out(Cycles opened_by, Cycles now, std::vector<RayPacket*>& departures) {
  for (std::uint32_t index = 0; index < cells_.size(); ++index) {
    if (cells_[index].packet != nullptr && cells_[index].opened <= opened_by) {
      close(index, Departure::kTimedOut, now, departures);
    }
  }
}

Cycles CellSorter::oldest_opening() const {
  Cycles oldest = kNever;
  for (const Cell& cell : cells_) {
    if (cell.packet != nullptr) oldest = std::min(oldest, cell.opened);
  }
  return oldest;
}

}  // namespace sheaf
