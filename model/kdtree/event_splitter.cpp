// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/event_splitter.h"

#include <algorithm>
#include <span>

#include "kdtree/clip.h"

namespace sheaf {
namespace {

// Values of side_, and what each kind of event of a triangle says before and behind the plane. A
// triangle that starts before the plane crosses it until its end is seen before or in the plane.
enum Side : std::uint8_t { kLeft = 1, kRight = 2, kCrossing = 3 };
constexpr std::array<std::uint8_t, 3> kSideBefore{kLeft, kLeft, kCrossing};

std::size_t index_of(EventKind kind) {
  return static_cast<std::size_t>(kind);
}

// Merges sorted `fresh` into the sorted first `count` of `list`, from the back and in place.
std::size_t merge_into(std::span<SplitEvent> list, std::size_t count,
                       std::span<const SplitEvent> fresh) {
  const std::size_t total = count + fresh.size();
  std::size_t write = total;
  std::size_t pending = fresh.size();
  while (pending > 0) {
    if (count > 0 && list[count - 1] > fresh[pending - 1]) {
      list[--write] = list[--count];
    } else {
      list[--write] = fresh[--pending];
    }
  }
  return total;
}

}  // namespace

void push_box_events(const Box& box, std::uint32_t triangle,
                     std::array<std::vector<SplitEvent>, 3>& events) {
  for (int axis = 0; axis < 3; ++axis) {
    auto& list = events[static_cast<std::size_t>(axis)];
    if (box.lo[axis] == box.hi[axis]) {
      list.push_back(make_event(box.lo[axis], EventKind::kPlanar, triangle));
    } else {
      list.push_back(make_event(box.lo[axis], EventKind::kStart, triangle));
      list.push_back(make_event(box.hi[axis], EventKind::kEnd, triangle));
    }
  }
}

void EventSplitter::classify(const NodeEvents& node, const Box& cell, const SplitPlane& plane) {
  num_side_ = {0, 0};
  crossing_.clear();
  assign_sides(node.axis[static_cast<std::size_t>(plane.axis)], plane);
  clip_crossing(cell, plane);
}

void EventSplitter::assign_sides(std::span<const SplitEvent> events, const SplitPlane& plane) {
  const std::uint32_t key = coordinate_key(plane.position);
  const SplitEvent* event = events.data();
  const SplitEvent* const last = event + events.size();
  std::size_t num_ends = 0;  // triangles known to be left, planar ones included
  for (; event != last && event_key(*event) < key; ++event) {
    const EventKind kind = event_kind(*event);
    side_[event_triangle(*event)] = kSideBefore[index_of(kind)];
    num_ends += kind != EventKind::kStart ? 1U : 0U;
  }
  std::size_t num_starts = 0;  // triangles known to be right, planar ones included
  for (; event != last && event_key(*event) == key; ++event) {
    const EventKind kind = event_kind(*event);
    const bool left = kind == EventKind::kEnd || (kind == EventKind::kPlanar && plane.planar_left);
    side_[event_triangle(*event)] = left ? kLeft : kRight;
    (left ? num_ends : num_starts) += 1;
  }
  for (; event != last; ++event) {
    const std::uint32_t triangle = event_triangle(*event);
    if (event_kind(*event) != EventKind::kEnd) {
      side_[triangle] = kRight;
      ++num_starts;
    } else if (side_[triangle] == kCrossing) {
      crossing_.push_back(triangle);
    }
  }
  num_side_ = {num_ends, num_starts};
}

void EventSplitter::clip_crossing(const Box& cell, const SplitPlane& plane) {
  for (auto& child : fresh_) {
    for (auto& list : child) list.clear();
  }
  for (const std::uint32_t triangle : crossing_) {
    const SplitParts parts =
        split_triangle(mesh_.corners(triangle), cell, plane.axis, plane.position);
    if (parts.in_left) add_part(0, parts.left, triangle);
    if (parts.in_right) add_part(1, parts.right, triangle);
  }
  for (auto& child : fresh_) {
    for (auto& list : child) std::sort(list.begin(), list.end());
  }
}

void EventSplitter::add_part(std::size_t child, const Box& box, std::uint32_t triangle) {
  push_box_events(box, triangle, fresh_[child]);
  ++num_side_[child];
}

void EventSplitter::distribute(const NodeEvents& node, NodeEvents& left, NodeEvents& right) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    SplitEvent* const to_left = left.axis[axis].data();
    SplitEvent* const to_right = right.axis[axis].data();
    std::size_t num_left = 0;
    std::size_t num_right = 0;
    // Written to both sides and counted on one, because a branch here would be mispredicted.
    for (const SplitEvent event : node.axis[axis]) {
      const std::uint8_t side = side_[event_triangle(event)];
      to_left[num_left] = event;
      to_right[num_right] = event;
      num_left += side == kLeft ? 1U : 0U;
      num_right += side == kRight ? 1U : 0U;
    }
    num_left = merge_into(left.axis[axis], num_left, fresh_[0][axis]);
    num_right = merge_into(right.axis[axis], num_right, fresh_[1][axis]);
    left.axis[axis] = left.axis[axis].first(num_left);
    right.axis[axis] = right.axis[axis].first(num_right);
  }
}

void EventSplitter::gather_boxes(const NodeEvents& node, SmallNode& small) {
  for (const SplitEvent event : node.axis[0]) {
    if (event_kind(event) != EventKind::kEnd) small.triangle[small.count++] = event_triangle(event);
  }
  std::sort(small.triangle.begin(),
            small.triangle.begin() + static_cast<std::ptrdiff_t>(small.count));
  // The bytes of side_ serve as a map from triangles to their places.
  for (std::size_t i = 0; i < small.count; ++i) {
    side_[small.triangle[i]] = static_cast<std::uint8_t>(i);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const SplitEvent event : node.axis[axis]) {
      const std::size_t place = side_[event_triangle(event)];
      const float x = key_coordinate(event_key(event));
      if (event_kind(event) != EventKind::kEnd) small.lo[axis][place] = x;
      if (event_kind(event) != EventKind::kStart) small.hi[axis][place] = x;
    }
  }
}

}  // namespace sheaf
