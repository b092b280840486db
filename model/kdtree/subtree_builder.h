// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/box.h"
#include "kdtree/event_arena.h"
#include "kdtree/event_splitter.h"
#include "kdtree/kd_tree.h"
#include "kdtree/mesh_view.h"
#include "kdtree/small_subtree.h"
#include "kdtree/split_search.h"

namespace sheaf {

/// A node still to be built.
struct PendingNode {
  NodeEvents events;
  Box cell;
  int depth = 0;  ///< inner nodes above it
};

/// Builds subtrees depth first on one thread. The events of a node stand on one of two stacks,
/// those of its children on the other: a node's memory is free again as soon as it is split, and no
/// event moves more than once a level.
class SubtreeBuilder {
 public:
  SubtreeBuilder(const MeshView& mesh, const SahCosts& costs, int max_depth)
      : splitter_(mesh), small_(mesh, costs, max_depth), costs_(costs), max_depth_(max_depth) {}

  /// Where root events may be put for build(), which frees them once they are used.
  [[nodiscard]] EventArena& root_arena() { return arenas_[0]; }

  /// Appends the subtree's nodes and leaf lists to `tree`.
  void build(const PendingNode& node, KdTree& tree) { build(node, 0, {}, tree); }

  /// The split that build() would make of this node; none if it would make a leaf.
  [[nodiscard]] SplitPlane choose_split(const PendingNode& node) const {
    return node.depth < max_depth_ ? find_split(node.events, node.cell, costs_) : SplitPlane{};
  }
  [[nodiscard]] EventSplitter& splitter() { return splitter_; }

 private:
  void build(const PendingNode& node, std::size_t arena, EventArena::Mark mark, KdTree& tree);
  void build_small(const PendingNode& node, KdTree& tree);
  void build_leaf(const PendingNode& node, KdTree& tree);

  EventSplitter splitter_;
  SmallSubtreeBuilder small_;
  SahCosts costs_;
  int max_depth_;
  std::array<EventArena, 2> arenas_;
  std::vector<std::uint32_t> leaf_;  // triangles of the leaf being built
};

}  // namespace sheaf
