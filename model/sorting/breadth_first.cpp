// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/breadth_first.h"

#include <algorithm>

namespace sheaf {
namespace {

std::uint32_t rank(RayKind kind) {
  if (kind == RayKind::kShadow) return 0;
  return kind == RayKind::kReflection ? 1 : 2;
}

}  // namespace

void BreadthFirstSorter::insert(const Ray& ray, Cycles /*now*/,
                                std::vector<RayPacket*>& /*departures*/) {
  held_[{ray.tag.depth, rank(ray.tag.kind)}].push_back(ray);
  stats_.max_held = std::max<std::uint64_t>(stats_.max_held, ++num_waiting_);
}

void BreadthFirstSorter::sweep(Departure why, Cycles now, std::vector<RayPacket*>& departures) {
  if (held_.empty()) return;
  const auto wave = held_.extract(held_.begin());
  for (const Ray& ray : wave.mapped()) sorter_->insert(ray, now, departures);
  sorter_->sweep(why, now, departures);
  num_waiting_ -= wave.mapped().size();
  const std::uint64_t max_held = stats_.max_held;
  stats_ = sorter_->stats();
  stats_.max_held = max_held;
  fill_ = sorter_->fill();
}

}  // namespace sheaf
