// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kdtree/kd_tree.h"

namespace sheaf {

/// What a finished tree looks like.
struct KdStats {
  std::uint64_t num_nodes = 0;   ///< inner nodes and leaves
  std::uint64_t num_leaves = 0;  ///< empty ones included
  std::uint64_t num_empty_leaves = 0;
  std::uint64_t num_references = 0;  ///< leaf-list entries; a triangle can stand in many leaves
  std::uint64_t max_leaf_size = 0;   ///< triangles
  double mean_leaf_size = 0.0;       ///< triangles per leaf that is not empty; 0 without any
  int depth = 0;                     ///< inner nodes on the longest path
  /// Expected cost of a random line that meets the bounds:
  ///   K_T Σ A(inner) / A(root) + K_I Σ A(leaf) n / A(root)
  /// (MacDonald and Booth, "Heuristics for ray tracing using space subdivision", The Visual
  /// Computer 6(3), 1990). If the root has no area: of the root alone.
  double sah_cost = 0.0;
};

[[nodiscard]] KdStats measure_kd_tree(const KdTree& tree, double traversal_cost,
                                      double intersection_cost);

}  // namespace sheaf
