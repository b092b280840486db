// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/tree_output.h"

#include <algorithm>
#include <limits>

#include "base/errors.h"

namespace sheaf {

std::uint32_t append_inner(KdTree& tree, const SplitPlane& plane) {
  const auto index = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.push_back(KdNode::inner(plane.axis, plane.position, 0));
  return index;
}

void set_right_child(KdTree& tree, std::uint32_t inner) {
  if (tree.nodes.size() > KdNode::kMaxIndex) {
    throw Error(ExitCode::kScene, "scene: its kd-tree has too many nodes; lower kdtree.max_depth");
  }
  KdNode& node = tree.nodes[inner];
  node = KdNode::inner(node.axis(), node.split(), static_cast<std::uint32_t>(tree.nodes.size()));
}

void append_leaf(KdTree& tree, std::span<const std::uint32_t> triangles, int depth) {
  const std::size_t first = tree.leaf_triangles.size();
  if (first + triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ExitCode::kScene,
                "scene: its kd-tree has too many leaf entries; lower kdtree.max_depth");
  }
  tree.leaf_triangles.insert(tree.leaf_triangles.end(), triangles.begin(), triangles.end());
  tree.nodes.push_back(KdNode::leaf(static_cast<std::uint32_t>(first),
                                    static_cast<std::uint32_t>(triangles.size())));
  tree.depth = std::max(tree.depth, depth);
}

}  // namespace sheaf
