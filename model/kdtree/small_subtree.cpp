// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/small_subtree.h"

#include <span>

#include "kdtree/clip.h"
#include "kdtree/tree_output.h"

namespace sheaf {
namespace {

void add_copy(const SmallNode& from, std::size_t index, SmallNode& to) {
  for (std::size_t k = 0; k < 3; ++k) {
    to.lo[k][to.count] = from.lo[k][index];
    to.hi[k][to.count] = from.hi[k][index];
  }
  to.triangle[to.count++] = from.triangle[index];
}

void add_box(const Box& box, std::uint32_t triangle, SmallNode& to) {
  for (int k = 0; k < 3; ++k) {
    to.lo[static_cast<std::size_t>(k)][to.count] = box.lo[k];
    to.hi[static_cast<std::size_t>(k)][to.count] = box.hi[k];
  }
  to.triangle[to.count++] = triangle;
}

}  // namespace

void SmallSubtreeBuilder::divide(const SmallNode& node, const Box& cell, const SplitPlane& plane,
                                 SmallNode& left, SmallNode& right) const {
  const auto& lo = node.lo[static_cast<std::size_t>(plane.axis)];
  const auto& hi = node.hi[static_cast<std::size_t>(plane.axis)];
  for (std::size_t i = 0; i < node.count; ++i) {
    const bool below = lo[i] < plane.position;
    const bool above = hi[i] > plane.position;
    if (below && above) {
      const std::uint32_t triangle = node.triangle[i];
      const SplitParts parts =
          split_triangle(mesh_.corners(triangle), cell, plane.axis, plane.position);
      if (parts.in_left) add_box(parts.left, triangle, left);
      if (parts.in_right) add_box(parts.right, triangle, right);
    } else {
      const bool is_left = below || (!above && plane.planar_left);
      add_copy(node, i, is_left ? left : right);
    }
  }
}

void SmallSubtreeBuilder::build(const SmallNode& node, const Box& cell, int depth,
                                KdTree& tree) const {
  const SplitPlane plane = depth < max_depth_ ? find_split(node, cell, costs_) : SplitPlane{};
  if (!plane.found()) {
    append_leaf(tree, std::span(node.triangle).first(node.count), depth);
    return;
  }
  SmallNode left;
  SmallNode right;
  divide(node, cell, plane, left, right);
  const auto [left_cell, right_cell] = split_cell(cell, plane);
  const std::uint32_t inner = append_inner(tree, plane);
  build(left, left_cell, depth + 1, tree);
  set_right_child(tree, inner);
  build(right, right_cell, depth + 1, tree);
}

}  // namespace sheaf
