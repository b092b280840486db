// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/ray.h"

namespace sheaf {

/// Rays by kind and depth; a function of the scene alone.
class RayCounts {
 public:
  struct Entry {
    std::uint64_t spawned = 0;
    std::uint64_t retired = 0;
    std::uint64_t hits = 0;  ///< shadow rays: occluded
    [[nodiscard]] bool operator==(const Entry&) const = default;
  };
  /// Rays up to depth recursion_level + 1 (the shadow rays of the deepest hits).
  explicit RayCounts(std::uint32_t recursion_level) : entries_(recursion_level + 2) {}

  void spawn(const RayTag& tag) { ++at(tag).spawned; }
  void retire(const RayTag& tag, bool hit) {
    Entry& entry = at(tag);
    ++entry.retired;
    if (hit) ++entry.hits;
  }
  [[nodiscard]] const std::vector<std::array<Entry, kNumRayKinds>>& by_depth() const {
    return entries_;
  }
  [[nodiscard]] Entry total() const {
    Entry sum;
    for (const auto& depth : entries_) {
      for (const Entry& entry : depth) {
        sum.spawned += entry.spawned;
        sum.retired += entry.retired;
        sum.hits += entry.hits;
      }
    }
    return sum;
  }
  [[nodiscard]] bool operator==(const RayCounts&) const = default;

 private:
  Entry& at(const RayTag& tag) { return entries_[tag.depth][static_cast<std::size_t>(tag.kind)]; }
  std::vector<std::array<Entry, kNumRayKinds>> entries_;
};

}  // namespace sheaf
