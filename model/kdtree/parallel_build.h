// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "kdtree/subtree_builder.h"

namespace sheaf {

/// Builds the tree of `root`, whose events stand in `memory`, with several threads: nodes with many
/// triangles are split one by one from a common queue, the subtrees below them are built whole. The
/// parts are joined depth first, so the tree is the one that SubtreeBuilder makes of the root.
void build_in_parallel(const MeshView& mesh, const SahCosts& costs, int max_depth, unsigned threads,
                       const PendingNode& root, std::unique_ptr<SplitEvent[]> memory, KdTree& tree);

}  // namespace sheaf
