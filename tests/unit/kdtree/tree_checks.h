// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "geometry/box.h"
#include "kdtree/build.h"
#include "kdtree/kd_tree.h"
#include "meshes.h"

namespace sheaf::test {

[[nodiscard]] KdTree build(const Mesh& mesh, const KdBuildOptions& options = {});

/// Fails the running test unless every node can be reached exactly once, split planes lie strictly
/// inside their cells, leaf lists follow each other without gaps, are ascending and name triangles
/// of the mesh, and the depth is right and within bounds.
void expect_well_formed(const KdTree& tree, const Mesh& mesh);

/// Calls visit(leaf, cell) for every leaf whose cell holds the point, borders included.
void for_leaves_around(const KdTree& tree, const Vec3d& point,
                       const std::function<void(const KdNode&, const Box&)>& visit);

[[nodiscard]] bool leaf_lists(const KdTree& tree, const KdNode& leaf, std::uint32_t triangle);

}  // namespace sheaf::test
