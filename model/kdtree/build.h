// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geometry/vec.h"
#include "kdtree/kd_tree.h"

namespace sheaf {

/// Costs are relative to each other; only their ratio shapes the tree.
struct KdBuildOptions {
  double traversal_cost = 15.0;     ///< of visiting an inner node
  double intersection_cost = 20.0;  ///< of testing one triangle
  double empty_bonus = 0.8;         ///< factor on the cost of a split with an empty side, (0, 1]
  int max_depth = 0;                ///< 0: 8 + 1.3 log2(triangles); never above kMaxKdDepth
  unsigned threads = 1;             ///< 0 counts as 1; the tree does not depend on it
};

/// Builds a kd-tree by the surface area heuristic with perfect splits: a triangle counts for a cell
/// with the box of its part inside the cell. The greedy sweep over sorted events, O(N log N), is
/// that of Wald and Havran, "On building fast kd-trees for ray tracing, and on doing that in
/// O(N log N)", IEEE Symposium on Interactive Ray Tracing 2006, sections 4.2 to 4.4; the depth
/// limit is that of Pharr, Jakob and Humphreys, "Physically Based Rendering", 3rd ed.,
/// section 4.4.1.
///
/// A triangle that crosses a split plane stands on both sides. One that only touches the plane
/// stands on its own side alone, and one that lies in the plane on the cheaper side alone; so a ray
/// that lies in a split plane must visit both children to find them all. A triangle with two equal
/// corners can never be hit and is in no leaf, but counts for the bounds.
///
/// Indices must be in range and positions finite. Throws Error (kScene) when a node or a leaf list
/// would not fit KdNode's fields.
[[nodiscard]] KdTree build_kd_tree(std::span<const Vec3> positions,
                                   std::span<const std::array<std::uint32_t, 3>> triangles,
                                   const KdBuildOptions& options = {});

}  // namespace sheaf
