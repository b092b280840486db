// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/box.h"
#include "kdtree/mesh_view.h"
#include "kdtree/small_node.h"
#include "kdtree/split_event.h"
#include "kdtree/split_search.h"

namespace sheaf {

/// Distributes a node's sorted events to its two children in linear time (Wald and Havran 2006,
/// section 4.4): events of triangles on one side keep their order, and those of triangles that
/// cross the plane are replaced by the sorted events of their clipped parts.
///
/// Used in two steps, so that the caller can provide memory of the right size between them. Holds
/// one byte per triangle of the mesh; one splitter serves one thread.
class EventSplitter {
 public:
  explicit EventSplitter(const MeshView& mesh) : mesh_(mesh), side_(mesh.triangles.size()) {}

  /// Decides on which side the node's triangles are; then num_left() and num_right() hold.
  void classify(const NodeEvents& node, const Box& cell, const SplitPlane& plane);
  [[nodiscard]] std::size_t num_left() const { return num_side_[0]; }
  [[nodiscard]] std::size_t num_right() const { return num_side_[1]; }

  /// Writes the children's events for the node just classified. left and right must be laid out by
  /// lay_node_events for num_left() and num_right(); their lists are cut to what was written.
  void distribute(const NodeEvents& node, NodeEvents& left, NodeEvents& right);

  /// Writes the boxes of a node with at most SmallNode::kCapacity triangles.
  void gather_boxes(const NodeEvents& node, SmallNode& small);

 private:
  void assign_sides(std::span<const SplitEvent> events, const SplitPlane& plane);
  void clip_crossing(const Box& cell, const SplitPlane& plane);
  void add_part(std::size_t child, const Box& box, std::uint32_t triangle);

  MeshView mesh_;
  std::vector<std::uint8_t> side_;                               // per triangle of the mesh
  std::vector<std::uint32_t> crossing_;                          // triangles that cross the plane
  std::array<std::array<std::vector<SplitEvent>, 3>, 2> fresh_;  // events of parts: child, axis
  std::array<std::size_t, 2> num_side_{};
};

/// Appends the events of a box with their coordinates on every axis.
void push_box_events(const Box& box, std::uint32_t triangle,
                     std::array<std::vector<SplitEvent>, 3>& events);

}  // namespace sheaf
