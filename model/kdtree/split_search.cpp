// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/split_search.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace sheaf {
namespace {

// Sweeps a plane along one axis of a cell and keeps the cheapest position.
class AxisSweep {
 public:
  AxisSweep(const Box& cell, int axis, const SahCosts& costs)
      : lo_(cell.lo[axis]),
        hi_(cell.hi[axis]),
        lo_key_(coordinate_key(cell.lo[axis])),
        hi_key_(coordinate_key(cell.hi[axis])),
        traversal_(costs.traversal),
        bonus_(costs.empty_bonus) {
    const Vec3d extent = Vec3d(cell.hi) - Vec3d(cell.lo);
    const double du = extent[(axis + 1) % 3];
    const double dv = extent[(axis + 2) % 3];
    const double scale = costs.intersection / half_area(cell);
    cap_ = scale * du * dv;
    side_ = scale * (du + dv);
  }

  // Returns true if a plane cheaper than `best` was found, which is then updated.
  bool run(std::span<const SplitEvent> events, std::size_t num_triangles, double& best,
           SplitPlane& plane) {
    if (events.empty()) return false;
    const auto all = static_cast<std::int64_t>(num_triangles);
    // Only the first and the last coordinate can leave a side empty.
    bool improved = try_empty_side(events.front(), 0, all, best, plane);
    improved |= try_empty_side(events.back(), all, 0, best, plane);
    return try_inside(events, all, best, plane) || improved;
  }

 private:
  [[nodiscard]] double cost(SplitEvent event, std::int64_t num_left, std::int64_t num_right) const {
    const auto x = static_cast<double>(key_coordinate(event_key(event)));
    return (cap_ + side_ * (x - lo_)) * static_cast<double>(num_left) +
           (cap_ + side_ * (hi_ - x)) * static_cast<double>(num_right);
  }

  bool try_empty_side(SplitEvent event, std::int64_t num_left, std::int64_t num_right, double& best,
                      SplitPlane& plane) const {
    const std::uint32_t key = event_key(event);
    const double total = bonus_ * (traversal_ + cost(event, num_left, num_right));
    if (!(total < best) || key <= lo_key_ || key >= hi_key_) return false;
    best = total;
    plane.position = key_coordinate(key);
    plane.planar_left = num_right == 0;
    return true;
  }

  bool try_inside(std::span<const SplitEvent> events, std::int64_t num_triangles, double& best,
                  SplitPlane& plane) const {
    std::int64_t num_left = 0;
    std::int64_t num_right = num_triangles;
    const SplitEvent* event = events.data();
    const SplitEvent* last = event + events.size();
    for (; event != last && event_key(*event) <= lo_key_; ++event) {
      // Nothing ends in the cell's lower face but what is planar there.
      const bool planar = event_kind(*event) == EventKind::kPlanar;
      num_right -= planar ? 1 : 0;
      ++num_left;
    }
    while (last != event && event_key(last[-1]) >= hi_key_) --last;

    // Between events at one coordinate the counts are too high, never too low, so the proper
    // counts, which one of them sees, win. Ends see the planar triangles on the right, starts on
    // the left.
    double least = best - traversal_;
    const SplitEvent* found = nullptr;
    bool planar_left = false;
    for (; event != last; ++event) {
      const EventKind kind = event_kind(*event);
      if (kind == EventKind::kPlanar) [[unlikely]] {
        const double right_cost = cost(*event, num_left, num_right);
        const double left_cost = cost(*event, ++num_left, --num_right);
        if (std::min(left_cost, right_cost) < least) {
          least = std::min(left_cost, right_cost);
          found = event;
          planar_left = left_cost < right_cost;
        }
        continue;
      }
      num_right -= kind == EventKind::kEnd ? 1 : 0;
      // Selections, not branches: whether a plane is the best so far cannot be predicted.
      const double value = cost(*event, num_left, num_right);
      const bool better = value < least;
      least = better ? value : least;
      found = better ? event : found;
      num_left += kind == EventKind::kStart ? 1 : 0;
    }
    if (found == nullptr) return false;
    best = least + traversal_;
    plane.position = key_coordinate(event_key(*found));
    plane.planar_left = event_kind(*found) == EventKind::kPlanar
                            ? planar_left
                            : event_kind(*found) == EventKind::kStart;
    return true;
  }

  double lo_, hi_;
  std::uint32_t lo_key_, hi_key_;
  double traversal_, bonus_;
  double cap_ = 0.0;   // K_I / A times the area of the cell's face across the axis
  double side_ = 0.0;  // K_I / A times the growth of a part's area with its extent
};

}  // namespace

SplitPlane find_split(const NodeEvents& events, const Box& cell, const SahCosts& costs) {
  SplitPlane plane;
  if (events.num_triangles == 0 || !(half_area(cell) > 0.0)) return plane;
  double best = costs.intersection * static_cast<double>(events.num_triangles);
  for (int axis = 0; axis < 3; ++axis) {
    AxisSweep sweep(cell, axis, costs);
    const auto& list = events.axis[static_cast<std::size_t>(axis)];
    if (sweep.run(list, events.num_triangles, best, plane)) plane.axis = axis;
  }
  return plane;
}

}  // namespace sheaf
