// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/opos.h"

#include <algorithm>

#include "sorting/dir.h"

namespace sheaf {

void OposSorter::insert(const Ray& ray, Cycles now, std::vector<RayPacket*>& /*departures*/) {
  const std::size_t group = by_kind_ ? kind_group(ray.tag.kind) : 0;
  auto& list = lists_[group * 8 + sign_code(ray.direction)];
  ++stats_.num_insertions;
  // A sign configuration's list takes the place of a cell.
  if (list.empty()) {
    ++stats_.num_misses;
  } else {
    ++stats_.num_hits;
  }
  list.push_back({ray, now});
  stats_.max_rays = std::max<std::uint64_t>(stats_.max_rays, ++num_waiting_);
  const auto open = std::count_if(lists_.begin(), lists_.end(),
                                  [](const auto& waiting) { return !waiting.empty(); });
  stats_.max_open_cells = std::max(stats_.max_open_cells, static_cast<std::uint64_t>(open));
}

void OposSorter::sweep(Departure why, Cycles now, std::vector<RayPacket*>& departures) {
  for (auto& list : lists_) form_packets(list, why, now, departures);
}

void OposSorter::form_packets(std::vector<Waiting>& list, Departure why, Cycles now,
                              std::vector<RayPacket*>& departures) {
  struct Candidate {
    float distance2;
    std::uint32_t index;  // into list: arrival order breaks ties
    bool operator<(const Candidate& other) const {
      return distance2 != other.distance2 ? distance2 < other.distance2 : index < other.index;
    }
  };
  std::vector<std::uint32_t> left(list.size());
  for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
  std::vector<Candidate> nearest;
  std::vector<std::uint8_t> taken(list.size(), 0);
  while (!left.empty()) {
    RayPacket* packet = pool_.acquire();
    const Vec3 first = list[left.front()].ray.origin;
    nearest.clear();
    for (const std::uint32_t index : left) {
      const Vec3 d = list[index].ray.origin - first;
      nearest.push_back({glm::dot(d, d), index});
    }
    const auto take = std::min<std::size_t>(static_cast<std::size_t>(packet->size), left.size());
    std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(take),
                      nearest.end());
    Cycles oldest = now;
    for (std::size_t lane = 0; lane < take; ++lane) {
      const Waiting& waiting = list[nearest[lane].index];
      packet->put(static_cast<int>(lane), waiting.ray);
      taken[nearest[lane].index] = 1;
      oldest = std::min(oldest, waiting.arrival);
    }
    std::erase_if(left, [&](std::uint32_t index) { return taken[index] != 0; });
    count_departure(why, *packet, oldest, now);
    departures.push_back(packet);
  }
  list.clear();
}

}  // namespace sheaf
