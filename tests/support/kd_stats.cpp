// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "support/kd_stats.h"

#include <algorithm>

#include "geometry/box.h"

namespace sheaf {
namespace {

// In double precision: the areas of tiny and huge scenes leave the range of float.
double half_area(const Box& cell) {
  const Vec3d e = glm::max(Vec3d(cell.hi) - Vec3d(cell.lo), Vec3d(0.0));
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

struct Walk {
  const KdTree& tree;
  KdStats& stats;
  double inner_area = 0.0;  // Σ A(inner), halved as all areas
  double leaf_area = 0.0;   // Σ A(leaf) n

  void visit(std::uint32_t index, const Box& cell, int depth) {
    const KdNode& node = tree.nodes[index];
    stats.depth = std::max(stats.depth, depth);
    if (node.is_leaf()) {
      visit_leaf(node, cell);
      return;
    }
    inner_area += half_area(cell);
    Box left = cell;
    Box right = cell;
    left.hi[node.axis()] = node.split();
    right.lo[node.axis()] = node.split();
    visit(index + 1, left, depth + 1);
    visit(node.right_child(), right, depth + 1);
  }

  void visit_leaf(const KdNode& node, const Box& cell) {
    const std::uint64_t count = node.count();
    leaf_area += half_area(cell) * static_cast<double>(count);
    ++stats.num_leaves;
    stats.num_empty_leaves += count == 0 ? 1U : 0U;
    stats.num_references += count;
    stats.max_leaf_size = std::max(stats.max_leaf_size, count);
  }
};

}  // namespace

KdStats measure_kd_tree(const KdTree& tree, double traversal_cost, double intersection_cost) {
  KdStats stats;
  Walk walk{tree, stats};
  walk.visit(0, tree.bounds, 0);
  stats.num_nodes = tree.nodes.size();
  const std::uint64_t num_filled = stats.num_leaves - stats.num_empty_leaves;
  if (num_filled > 0) {
    stats.mean_leaf_size =
        static_cast<double>(stats.num_references) / static_cast<double>(num_filled);
  }
  const double root_area = half_area(tree.bounds);
  const KdNode& root = tree.nodes.front();
  if (root_area > 0.0) {
    stats.sah_cost =
        (traversal_cost * walk.inner_area + intersection_cost * walk.leaf_area) / root_area;
  } else if (root.is_leaf()) {
    stats.sah_cost = intersection_cost * static_cast<double>(root.count());
  }
  return stats;
}

}  // namespace sheaf
