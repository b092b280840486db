// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/box.h"
#include "kdtree/kd_tree.h"
#include "kdtree/split_search.h"

namespace sheaf {

// Nodes are appended depth first: an inner node, its left subtree, its right subtree.

/// Throws Error (kScene) if the tree cannot take as many more nodes and leaf entries.
void check_room(const KdTree& tree, std::size_t num_nodes, std::size_t num_entries);
/// Appends an inner node whose right child is not known yet; returns its index.
std::uint32_t append_inner(KdTree& tree, const SplitPlane& plane);
/// Completes an inner node: its right child is the next node to be appended.
void set_right_child(KdTree& tree, std::uint32_t inner);
/// Appends a leaf with the given triangles, which must ascend, below `depth` inner nodes.
void append_leaf(KdTree& tree, std::span<const std::uint32_t> triangles, int depth);

/// The left and the right part of a cell.
[[nodiscard]] inline std::array<Box, 2> split_cell(const Box& cell, const SplitPlane& plane) {
  std::array<Box, 2> parts{cell, cell};
  parts[0].hi[plane.axis] = plane.position;
  parts[1].lo[plane.axis] = plane.position;
  return parts;
}

}  // namespace sheaf
