// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/box.h"
#include "kdtree/kd_tree.h"
#include "kdtree/mesh_view.h"
#include "kdtree/small_node.h"
#include "kdtree/split_search.h"

namespace sheaf {

/// Builds subtrees of few triangles, where moving sorted events costs more than having none.
class SmallSubtreeBuilder {
 public:
  SmallSubtreeBuilder(const MeshView& mesh, const SahCosts& costs, int max_depth)
      : mesh_(mesh), costs_(costs), max_depth_(max_depth) {}

  /// Appends the subtree's nodes and leaf lists to `tree`; `depth` inner nodes are above it.
  void build(const SmallNode& node, const Box& cell, int depth, KdTree& tree) const;

 private:
  void divide(const SmallNode& node, const Box& cell, const SplitPlane& plane, SmallNode& left,
              SmallNode& right) const;

  MeshView mesh_;
  SahCosts costs_;
  int max_depth_;
};

}  // namespace sheaf
