// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.h"
#include "kdtree/kd_tree.h"
#include "kdtree/memory_map.h"
#include "kdtree/tree_cache.h"
#include "scene/scene.h"
#include "traversal/trace.h"

namespace sheaf {

/// Where everything that a frame touches stands; depends on image size and film format.
[[nodiscard]] MemoryMap map_memory(const Scene& scene, const KdTree& tree, const Config& config);

/// A scene with everything that is made of it once, before time begins.
struct PreparedScene {
  /// `trees`: where the kd-tree may stand already; may be null.
  PreparedScene(Scene&& loaded, const Config& config, const TreeCache* trees = nullptr);

  Scene scene;
  KdTree tree;
  std::vector<TriangleRecord> triangles;
  MemoryMap memory;
};

}  // namespace sheaf
