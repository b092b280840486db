// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "meshes.h"
#include "support/kd_stats.h"
#include "tree_checks.h"

namespace sheaf::test {
namespace {

bool same_tree(const KdTree& a, const KdTree& b) {
  return a.nodes.size() == b.nodes.size() && a.leaf_triangles == b.leaf_triangles &&
         a.bounds == b.bounds && a.depth == b.depth &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(KdNode)) == 0;
}

TEST(KdBuild, TreesAreWellFormed) {
  for (const Mesh& mesh : sample_meshes()) {
    const KdTree tree = build(mesh);
    expect_well_formed(tree, mesh);
    EXPECT_GT(tree.depth, 3) << mesh.name;
  }
}

TEST(KdBuild, BoundsAreThoseOfAllTriangles) {
  for (const Mesh& mesh : sample_meshes()) {
    Box bounds;
    for (const Vec3& position : mesh.positions) bounds.add(position);
    EXPECT_EQ(build(mesh).bounds, bounds) << mesh.name;
  }
}

TEST(KdBuild, TreeDoesNotDependOnThreads) {
  std::vector<Mesh> meshes = sample_meshes();
  meshes.push_back(random_soup(30'000, 0.03F));
  meshes.push_back(boxes_in_room(30));
  for (const Mesh& mesh : meshes) {
    const KdTree tree = build(mesh);
    for (const unsigned threads : {0U, 2U, 3U, 8U}) {
      EXPECT_TRUE(same_tree(tree, build(mesh, {.threads = threads}))) << mesh.name << threads;
    }
  }
}

TEST(KdBuild, DepthLimitHolds) {
  const Mesh mesh = random_soup(2000, 0.1F);
  for (const int limit : {1, 2, 7}) {
    const KdTree tree = build(mesh, {.max_depth = limit});
    EXPECT_EQ(tree.depth, limit);
    expect_well_formed(tree, mesh);
  }
  // 8 + 1.3 log2(2000) = 22.3
  EXPECT_LE(build(mesh).depth, 22);
}

TEST(KdBuild, DepthLimitIsNeverAboveWhatStacksHold) {
  // Triangles at every power of two invite one split each, far deeper than the limit.
  Mesh mesh{.name = "powers", .positions = {}, .triangles = {}};
  for (int i = -100; i < 100; ++i) {
    const float x = std::ldexp(1.0F, i);
    mesh.add({x, 0.0F, 0.0F}, {x, x, 0.0F}, {x, 0.0F, x});
  }
  const KdTree tree = build(mesh, {.intersection_cost = 1e6, .max_depth = 1000});
  expect_well_formed(tree, mesh);
  EXPECT_EQ(tree.depth, kMaxKdDepth);
}

TEST(KdBuild, DearTraversalMakesOneLeaf) {
  const Mesh mesh = random_soup(100, 0.1F);
  const KdTree tree = build(mesh, {.traversal_cost = 1e9});
  ASSERT_EQ(tree.nodes.size(), 1U);
  EXPECT_EQ(tree.nodes[0].count(), 100U);
}

TEST(KdBuild, EmptyBonusCutsOffEmptySpace) {
  // Two triangles 3.5 long at the ends of a room 10 long. Cutting the gap between them off the
  // second one's cell costs K_T + K_I 8/14 = 26.4, dearer than its leaf's 20 unless it is favoured.
  Mesh mesh{.name = "halves", .positions = {}, .triangles = {}};
  mesh.add({0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {3.5F, 0.0F, 1.0F});
  mesh.add({10.0F, 0.0F, 0.0F}, {10.0F, 1.0F, 0.0F}, {6.5F, 0.0F, 1.0F});
  const auto empty_leaves = [&](double bonus) {
    return measure_kd_tree(build(mesh, {.empty_bonus = bonus}), 15.0, 20.0).num_empty_leaves;
  };
  EXPECT_EQ(empty_leaves(1.0), 0U);
  EXPECT_EQ(empty_leaves(0.7), 1U);
}

// A wall in the middle of other things: a plane through it costs least when the wall goes to the
// smaller cell. Each case has the same geometry, mirrored.
TEST(KdBuild, PlanarTrianglesGoToTheCheaperSide) {
  for (const bool mirrored : {false, true}) {
    Mesh mesh{.name = "wall", .positions = {}, .triangles = {}};
    const auto x = [mirrored](float value) { return mirrored ? 10.0F - value : value; };
    for (int i = 0; i < 20; ++i) {
      const float y = 0.05F * static_cast<float>(i);
      mesh.add({x(2.0F), y, 0.0F}, {x(2.0F), y, 1.0F}, {x(2.0F), y + 0.05F, 0.0F});
    }
    mesh.add({x(0.0F), 0.0F, 0.0F}, {x(0.0F), 1.0F, 1.0F}, {x(10.0F), 0.5F, 0.5F});
    const KdTree tree = build(mesh, {.max_depth = 1});
    ASSERT_EQ(tree.nodes.size(), 3U);
    EXPECT_EQ(tree.nodes[0].axis(), 0);
    EXPECT_EQ(tree.nodes[0].split(), x(2.0F));
    EXPECT_EQ(tree.nodes[mirrored ? 2 : 1].count(), 21U);
    EXPECT_EQ(tree.nodes[mirrored ? 1 : 2].count(), 1U);
  }
}

TEST(KdBuild, ClippedTrianglesLeaveCellsTheyOnlyBoundWithTheirBox) {
  // Slivers along the diagonal of a cube: their boxes fill it, their parts do not. The shorter ones
  // invite splits all along it.
  Mesh mesh{.name = "diagonal", .positions = {}, .triangles = {}};
  for (int i = 1; i <= 32; ++i) {
    const float end = static_cast<float>(i) / 32.0F;
    mesh.add({0.0F, 0.0F, 0.0F}, Vec3(end), {0.0F, 0.001F, 0.0F});
  }
  const KdTree tree = build(mesh);
  std::size_t listed = 0;
  for_leaves_around(tree, {0.9, 0.1, 0.5},
                    [&](const KdNode& leaf, const Box&) { listed += leaf.count(); });
  EXPECT_EQ(listed, 0U);
}

}  // namespace
}  // namespace sheaf::test
