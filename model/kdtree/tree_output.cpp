// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/tree_output.h"

#include <algorithm>
#include <limits>

#include "base/errors.h"

namespace sheaf {

void check_room(const KdTree& tree, std::size_t num_nodes, std::size_t num_entries) {
  constexpr std::size_t kMaxEntries = std::numeric_limits<std::uint32_t>::max();
  if (tree.nodes.size() + num_nodes > KdNode::kMaxIndex ||
      tree.leaf_triangles.size() + num_entries > kMaxEntries) {
    throw Error(ExitCode::kScene, "scene: its kd-tree grows too large; lower kdtree.max_depth");
  }
}

std::uint32_t append_inner(KdTree& tree, const SplitPlane& plane) {
  check_room(tree, 1, 0);
  const auto index = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.push_back(KdNode::inner(plane.axis, plane.position, 0));
  return index;
}

void set_right_child(KdTree& tree, std::uint32_t inner) {
  KdNode& node = tree.nodes[inner];
  node = KdNode::inner(node.axis(), node.split(), static_cast<std::uint32_t>(tree.nodes.size()));
}

void append_leaf(KdTree& tree, std::span<const std::uint32_t> triangles, int depth) {
  check_room(tree, 1, triangles.size());
  const auto first = static_cast<std::uint32_t>(tree.leaf_triangles.size());
  tree.leaf_triangles.insert(tree.leaf_triangles.end(), triangles.begin(), triangles.end());
  tree.nodes.push_back(KdNode::leaf(first, static_cast<std::uint32_t>(triangles.size())));
  tree.depth = std::max(tree.depth, depth);
}

}  // namespace sheaf
