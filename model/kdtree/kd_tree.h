// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "geometry/box.h"

namespace sheaf {

/// One kd-tree node in 8 bytes. An inner node's left child stands right behind it and its right
/// child at right_child(); the left child holds what is at or below the split plane.
class KdNode {
 public:
  static constexpr std::uint32_t kMaxIndex = (1U << 30) - 1;

  [[nodiscard]] static KdNode inner(int axis, float split, std::uint32_t right_child) {
    return {std::bit_cast<std::uint32_t>(split),
            static_cast<std::uint32_t>(axis) | (right_child << 2)};
  }
  /// A leaf over leaf_triangles[first, first + count).
  [[nodiscard]] static KdNode leaf(std::uint32_t first, std::uint32_t count) {
    return {first, 3U | (count << 2)};
  }
  KdNode() : KdNode(leaf(0, 0)) {}

  [[nodiscard]] bool is_leaf() const { return (word1_ & 3U) == 3U; }
  [[nodiscard]] int axis() const { return static_cast<int>(word1_ & 3U); }
  [[nodiscard]] float split() const { return std::bit_cast<float>(word0_); }
  [[nodiscard]] std::uint32_t right_child() const { return word1_ >> 2; }
  [[nodiscard]] std::uint32_t first() const { return word0_; }
  [[nodiscard]] std::uint32_t count() const { return word1_ >> 2; }

 private:
  KdNode(std::uint32_t word0, std::uint32_t word1) : word0_(word0), word1_(word1) {}
  std::uint32_t word0_;
  std::uint32_t word1_;
};
static_assert(sizeof(KdNode) == 8);

/// Node 0 is the root; there is always at least one node. Nodes stand depth first, an inner node
/// before its left and that before its right subtree; the lists of the leaves stand in the same
/// order. A triangle that only touches a split plane stands on its own side alone, so a ray that
/// lies in the plane must visit both children.
struct KdTree {
  std::vector<KdNode> nodes;
  std::vector<std::uint32_t> leaf_triangles;  ///< primitive numbers, ascending within a leaf
  Box bounds;                                 ///< of all triangles
  int depth = 0;                              ///< inner nodes on the longest path; <= kMaxKdDepth

  /// Empty ones included: every inner node has two children.
  [[nodiscard]] std::size_t num_leaves() const { return (nodes.size() + 1) / 2; }
};

/// The deepest tree that builders make and that traversal stacks must hold.
inline constexpr int kMaxKdDepth = 64;

}  // namespace sheaf
