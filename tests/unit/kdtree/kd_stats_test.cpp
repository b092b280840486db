// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "support/kd_stats.h"

#include <gtest/gtest.h>

namespace sheaf::test {
namespace {

// A cube of edge 2 cut at x = 1, its right half cut at y = 0.5:
// leaves of 3, 0 and 2 triangles, areas 16, 2·(1·0.5 + 0.5·2 + 2·1) = 7 and 13.
KdTree small_tree() {
  KdTree tree;
  tree.bounds.add(Vec3(0.0F));
  tree.bounds.add(Vec3(2.0F));
  tree.nodes = {KdNode::inner(0, 1.0F, 2), KdNode::leaf(0, 3), KdNode::inner(1, 0.5F, 4),
                KdNode::leaf(3, 0), KdNode::leaf(3, 2)};
  tree.leaf_triangles = {0, 1, 2, 1, 2};
  tree.depth = 2;
  return tree;
}

TEST(KdStats, CountsNodesAndReferences) {
  const KdStats stats = measure_kd_tree(small_tree(), 15.0, 20.0);
  EXPECT_EQ(stats.num_nodes, 5U);
  EXPECT_EQ(stats.num_leaves, 3U);
  EXPECT_EQ(stats.num_empty_leaves, 1U);
  EXPECT_EQ(stats.num_references, 5U);
  EXPECT_EQ(stats.max_leaf_size, 3U);
  EXPECT_DOUBLE_EQ(stats.mean_leaf_size, 2.5);
  EXPECT_EQ(stats.depth, 2);
}

TEST(KdStats, CostIsThatOfTheFormula) {
  const double expected = (15.0 * (24.0 + 16.0) + 20.0 * (16.0 * 3.0 + 13.0 * 2.0)) / 24.0;
  EXPECT_DOUBLE_EQ(measure_kd_tree(small_tree(), 15.0, 20.0).sah_cost, expected);
}

TEST(KdStats, LoneLeafCostsItsTriangles) {
  KdTree tree;
  tree.nodes = {KdNode::leaf(0, 4)};
  tree.leaf_triangles = {0, 1, 2, 3};
  tree.bounds.add(Vec3(1.0F));  // a point: no area
  EXPECT_DOUBLE_EQ(measure_kd_tree(tree, 15.0, 20.0).sah_cost, 80.0);
  tree.bounds.add(Vec3(3.0F));
  EXPECT_DOUBLE_EQ(measure_kd_tree(tree, 15.0, 20.0).sah_cost, 80.0);
}

TEST(KdStats, EmptyTreeCostsNothing) {
  KdTree tree;
  tree.nodes = {KdNode()};
  const KdStats stats = measure_kd_tree(tree, 15.0, 20.0);
  EXPECT_EQ(stats.sah_cost, 0.0);
  EXPECT_EQ(stats.mean_leaf_size, 0.0);
  EXPECT_EQ(stats.num_empty_leaves, 1U);
}

}  // namespace
}  // namespace sheaf::test
