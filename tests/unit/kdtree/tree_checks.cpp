// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tree_checks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sheaf::test {
namespace {

struct Checker {
  const KdTree& tree;
  std::size_t num_triangles;
  std::size_t num_visited = 0;
  std::size_t next_entry = 0;
  int depth = 0;

  void visit(std::size_t index, const Box& cell, int level) {
    ASSERT_LT(index, tree.nodes.size());
    ASSERT_EQ(index, num_visited) << "nodes are not in depth-first order";
    ++num_visited;
    depth = std::max(depth, level);
    const KdNode& node = tree.nodes[index];
    if (node.is_leaf()) {
      visit_leaf(node);
      return;
    }
    const int axis = node.axis();
    ASSERT_GT(node.split(), cell.lo[axis]);
    ASSERT_LT(node.split(), cell.hi[axis]);
    Box left = cell;
    Box right = cell;
    left.hi[axis] = node.split();
    right.lo[axis] = node.split();
    ASSERT_NO_FATAL_FAILURE(visit(index + 1, left, level + 1));
    ASSERT_NO_FATAL_FAILURE(visit(node.right_child(), right, level + 1));
  }

  void visit_leaf(const KdNode& leaf) {
    ASSERT_EQ(leaf.first(), next_entry);
    next_entry += leaf.count();
    ASSERT_LE(next_entry, tree.leaf_triangles.size());
    for (std::size_t i = leaf.first(); i < next_entry; ++i) {
      ASSERT_LT(tree.leaf_triangles[i], num_triangles);
      if (i > leaf.first()) {
        ASSERT_LT(tree.leaf_triangles[i - 1], tree.leaf_triangles[i]);
      }
    }
  }
};

void descend(const KdTree& tree, std::size_t index, const Box& cell, const Vec3d& point,
             const std::function<void(const KdNode&, const Box&)>& visit) {
  const KdNode& node = tree.nodes[index];
  if (node.is_leaf()) {
    visit(node, cell);
    return;
  }
  const int axis = node.axis();
  const auto split = static_cast<double>(node.split());
  Box left = cell;
  Box right = cell;
  left.hi[axis] = node.split();
  right.lo[axis] = node.split();
  if (point[axis] <= split) descend(tree, index + 1, left, point, visit);
  if (point[axis] >= split) descend(tree, node.right_child(), right, point, visit);
}

}  // namespace

KdTree build(const Mesh& mesh, const KdBuildOptions& options) {
  return build_kd_tree(mesh.positions, mesh.triangles, options);
}

void expect_well_formed(const KdTree& tree, const Mesh& mesh) {
  SCOPED_TRACE(mesh.name);
  Checker checker{tree, mesh.triangles.size()};
  checker.visit(0, tree.bounds, 0);
  EXPECT_EQ(checker.num_visited, tree.nodes.size());
  EXPECT_EQ(checker.next_entry, tree.leaf_triangles.size());
  EXPECT_EQ(checker.depth, tree.depth);
  EXPECT_LE(tree.depth, kMaxKdDepth);
}

void for_leaves_around(const KdTree& tree, const Vec3d& point,
                       const std::function<void(const KdNode&, const Box&)>& visit) {
  descend(tree, 0, tree.bounds, point, visit);
}

bool leaf_lists(const KdTree& tree, const KdNode& leaf, std::uint32_t triangle) {
  const auto first = tree.leaf_triangles.begin() + leaf.first();
  return std::binary_search(first, first + leaf.count(), triangle);
}

}  // namespace sheaf::test
