// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "meshes.h"
#include "support/kd_stats.h"
#include "tree_checks.h"

namespace sheaf::test {
namespace {

Mesh empty_mesh(const char* name) {
  return {.name = name, .positions = {}, .triangles = {}};
}

TEST(KdDegenerate, NoTriangleGivesOneEmptyLeaf) {
  const KdTree tree = build(empty_mesh("none"));
  ASSERT_EQ(tree.nodes.size(), 1U);
  EXPECT_TRUE(tree.nodes[0].is_leaf());
  EXPECT_EQ(tree.nodes[0].count(), 0U);
  EXPECT_EQ(tree.depth, 0);
}

TEST(KdDegenerate, OneTriangleIsFound) {
  Mesh mesh = empty_mesh("one");
  mesh.add({0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.5F});
  const KdTree tree = build(mesh);
  expect_well_formed(tree, mesh);
  EXPECT_FALSE(tree.leaf_triangles.empty());
}

TEST(KdDegenerate, TrianglesAllInOnePlaceEndInOneLeaf) {
  for (const unsigned threads : {1U, 4U}) {
    Mesh mesh = empty_mesh("stack");
    for (int i = 0; i < 5000; ++i) {
      mesh.add({0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 1.0F});
    }
    const KdTree tree = build(mesh, {.threads = threads});
    expect_well_formed(tree, mesh);
    EXPECT_EQ(measure_kd_tree(tree, 15.0, 20.0).max_leaf_size, 5000U);
  }
}

TEST(KdDegenerate, EqualCornersAreLeftOutOfLeavesOnly) {
  Mesh mesh = empty_mesh("points");
  const Vec3 far_corner(9.0F, 9.0F, 9.0F);
  mesh.add(far_corner, far_corner, far_corner);
  mesh.add({0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.5F});
  mesh.add({0.0F, 0.0F, 0.0F}, {-0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.5F});
  mesh.add({0.0F, 1.0F, 0.0F}, {0.5F, 0.0F, 0.0F}, {0.5F, 0.0F, 0.0F});
  const KdTree tree = build(mesh);
  expect_well_formed(tree, mesh);
  ASSERT_FALSE(tree.leaf_triangles.empty());
  for (const std::uint32_t triangle : tree.leaf_triangles) EXPECT_EQ(triangle, 1U);
  EXPECT_EQ(tree.bounds.hi, far_corner);
}

TEST(KdDegenerate, OnlyTrianglesWithEqualCornersGiveOneEmptyLeaf) {
  Mesh mesh = empty_mesh("points");
  for (int i = 0; i < 10; ++i) mesh.add(Vec3(1.0F), Vec3(2.0F), Vec3(1.0F));
  const KdTree tree = build(mesh);
  ASSERT_EQ(tree.nodes.size(), 1U);
  EXPECT_EQ(tree.nodes[0].count(), 0U);
}

TEST(KdDegenerate, CollinearTrianglesStay) {
  Mesh mesh = empty_mesh("collinear");
  for (int i = 0; i < 50; ++i) {
    const float x = static_cast<float>(i);
    mesh.add({x, 0.0F, 0.0F}, {x + 1.0F, 1.0F, 1.0F}, {x + 2.0F, 2.0F, 2.0F});
  }
  const KdTree tree = build(mesh);
  expect_well_formed(tree, mesh);
  std::vector<bool> listed(50);
  for (const std::uint32_t triangle : tree.leaf_triangles) listed[triangle] = true;
  for (const bool found : listed) EXPECT_TRUE(found);
}

TEST(KdDegenerate, TrianglesOnOneLineHaveNoAreaAndGiveOneLeaf) {
  Mesh mesh = empty_mesh("line");
  for (int i = 0; i < 20; ++i) {
    const float x = static_cast<float>(i);
    mesh.add({x, 0.0F, 0.0F}, {x + 1.0F, 0.0F, 0.0F}, {x + 3.0F, 0.0F, 0.0F});
  }
  const KdTree tree = build(mesh);
  expect_well_formed(tree, mesh);
  EXPECT_EQ(tree.leaf_triangles.size(), 20U);
}

TEST(KdDegenerate, FlatScenesAreSplitAlongTheirTwoAxes) {
  for (const float height : {0.0F, -0.0F, 5.0F, -1e6F}) {
    const Mesh mesh = flat_grid(20, height);
    const KdTree tree = build(mesh);
    expect_well_formed(tree, mesh);
    for (const KdNode& node : tree.nodes) {
      EXPECT_TRUE(node.is_leaf() || node.axis() != 2);
    }
    EXPECT_LT(measure_kd_tree(tree, 15.0, 20.0).max_leaf_size, 10U);
  }
}

TEST(KdDegenerate, ExtremeCoordinatesStayFinite) {
  for (const float scale : {1e-38F, 1e-30F, 1e30F, 1e38F}) {
    const Mesh mesh = transformed(random_soup(300, 0.2F), scale, 0.0F);
    const KdTree tree = build(mesh);
    expect_well_formed(tree, mesh);
    EXPECT_GT(tree.depth, 3) << scale;
    EXPECT_LT(measure_kd_tree(tree, 15.0, 20.0).sah_cost, 20.0 * 300.0) << scale;
  }
}

TEST(KdDegenerate, ScaleByPowersOfTwoDoesNotChangeTheTree) {
  const Mesh mesh = random_soup(500, 0.2F);
  const KdTree tree = build(mesh);
  for (const float scale : {0x1p-40F, 0x1p40F}) {
    const KdTree scaled = build(transformed(mesh, scale, 0.0F));
    ASSERT_EQ(scaled.nodes.size(), tree.nodes.size());
    EXPECT_EQ(scaled.leaf_triangles, tree.leaf_triangles);
  }
}

}  // namespace
}  // namespace sheaf::test
