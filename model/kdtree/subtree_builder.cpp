// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/subtree_builder.h"

#include <algorithm>

#include "kdtree/small_node.h"
#include "kdtree/tree_output.h"

namespace sheaf {

void SubtreeBuilder::build_leaf(const PendingNode& node, KdTree& tree) {
  leaf_.clear();
  for (const SplitEvent event : node.events.axis[0]) {
    if (event_kind(event) != EventKind::kEnd) leaf_.push_back(event_triangle(event));
  }
  std::sort(leaf_.begin(), leaf_.end());
  append_leaf(tree, leaf_, node.depth);
}

void SubtreeBuilder::build_small(const PendingNode& node, KdTree& tree) {
  SmallNode small;
  splitter_.gather_boxes(node.events, small);
  small_.build(small, node.cell, node.depth, tree);
}

void SubtreeBuilder::build(const PendingNode& node, std::size_t arena, EventArena::Mark mark,
                           KdTree& tree) {
  if (node.events.num_triangles <= SmallNode::kCapacity) {
    build_small(node, tree);
    arenas_[arena].release(mark);
    return;
  }
  const SplitPlane plane = choose_split(node);
  if (!plane.found()) {
    build_leaf(node, tree);
    arenas_[arena].release(mark);
    return;
  }
  splitter_.classify(node.events, node.cell, plane);
  const auto [left_cell, right_cell] = split_cell(node.cell, plane);
  const auto lay_child = [&](const Box& cell, std::size_t num_triangles) {
    SplitEvent* const memory = arenas_[1 - arena].allocate(node_events_room(num_triangles));
    return PendingNode{lay_node_events(memory, num_triangles), cell, node.depth + 1};
  };
  // The left child lies on top, because it is built and released first.
  const EventArena::Mark right_mark = arenas_[1 - arena].mark();
  PendingNode right = lay_child(right_cell, splitter_.num_right());
  const EventArena::Mark left_mark = arenas_[1 - arena].mark();
  PendingNode left = lay_child(left_cell, splitter_.num_left());
  splitter_.distribute(node.events, left.events, right.events);
  arenas_[arena].release(mark);

  const std::uint32_t inner = append_inner(tree, plane);
  build(left, 1 - arena, left_mark, tree);
  set_right_child(tree, inner);
  build(right, 1 - arena, right_mark, tree);
}

}  // namespace sheaf
