// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/grid_sorter.h"

#include <algorithm>

#include "sorting/kind_group.h"

namespace sheaf {

GridSorter::GridSorter(const SorterOptions& options, const Box& scene_bounds, PacketPool& pool)
    : RaySorter(pool),
      grid_(scene_bounds, static_cast<std::uint32_t>(options.heuristic.x)),
      by_kind_(options.group_by_kind),
      packet_size_(static_cast<std::size_t>(pool.packet_size())),
      capacity_(options.num_cells * packet_size_),
      num_resident_(options.resident_voxels),
      queues_(grid_.num_voxels() * (by_kind_ ? kNumKindGroups : 1)) {}

void GridSorter::insert(const Ray& ray, Cycles now, std::vector<RayPacket*>& departures) {
  const std::size_t group = by_kind_ ? kind_group(ray.tag.kind) : 0;
  const auto index =
      static_cast<std::uint32_t>(grid_.voxel(ray.origin) + group * grid_.num_voxels());
  Queue& queue = queues_[index];
  ++stats_.num_insertions;
  if (queue.empty()) {
    ++stats_.num_misses;
    occupied_.push_back(index);
  } else {
    ++stats_.num_hits;
  }
  queue.push_back({ray, now});
  stats_.max_rays = std::max<std::uint64_t>(stats_.max_rays, ++num_waiting_);
  stats_.max_open_cells = std::max<std::uint64_t>(stats_.max_open_cells, occupied_.size());
  if (num_waiting_ == capacity_) {
    schedule(choose(packet_size_), Departure::kEvicted, now, departures);
  }
}

std::uint32_t GridSorter::choose(std::size_t least) const {
  for (const std::uint32_t voxel : residents_) {
    for (std::size_t i = voxel; i < queues_.size(); i += grid_.num_voxels()) {
      if (queues_[i].size() >= least) return static_cast<std::uint32_t>(i);
    }
  }
  // Of equally full ones the first in occupied_, which has waited longest.
  return *std::max_element(
      occupied_.begin(), occupied_.end(),
      [this](std::uint32_t a, std::uint32_t b) { return queues_[a].size() < queues_[b].size(); });
}

void GridSorter::schedule(std::uint32_t index, Departure why, Cycles now,
                          std::vector<RayPacket*>& departures) {
  Queue& queue = queues_[index];
  for (std::size_t begin = 0; begin < queue.size(); begin += packet_size_) {
    const std::size_t end = std::min(begin + packet_size_, queue.size());
    RayPacket* packet = pool_.acquire();
    for (std::size_t i = begin; i < end; ++i) {
      packet->put(static_cast<int>(i - begin), queue[i].ray);
    }
    const bool full = end - begin == packet_size_;
    const Departure reason = full ? Departure::kFull : why;
    if (reason == Departure::kEvicted) ++stats_.num_evictions;
    count_departure(reason, *packet, queue[begin].arrival, now);
    departures.push_back(packet);
  }
  queue.clear();
  std::erase(occupied_, index);
  make_resident(index % grid_.num_voxels());
}

void GridSorter::make_resident(std::uint32_t voxel) {
  std::erase(residents_, voxel);
  residents_.insert(residents_.begin(), voxel);
  if (residents_.size() > num_resident_) residents_.pop_back();
}

void GridSorter::sweep(Departure why, Cycles now, std::vector<RayPacket*>& departures) {
  while (!occupied_.empty()) schedule(choose(1), why, now, departures);
}

void GridSorter::time_out(Cycles opened_by, Cycles now, std::vector<RayPacket*>& departures) {
  const std::vector<std::uint32_t> occupied = occupied_;
  for (const std::uint32_t index : occupied) {
    if (queues_[index].front().arrival > opened_by) continue;
    schedule(index, Departure::kTimedOut, now, departures);
  }
}

Cycles GridSorter::oldest_opening() const {
  return occupied_.empty() ? kNever : queues_[occupied_.front()].front().arrival;
}

}  // namespace sheaf
