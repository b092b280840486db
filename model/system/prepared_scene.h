// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.h"
#include "kdtree/kd_tree.h"
#include "kdtree/memory_map.h"
#include "scene/scene.h"
#include "traversal/trace.h"

namespace sheaf {

/// A scene with everything that is made of it once, before time begins.
struct PreparedScene {
  PreparedScene(Scene&& loaded, const Config& config);

  Scene scene;
  KdTree tree;
  std::vector<TriangleRecord> triangles;
  MemoryMap memory;
};

}  // namespace sheaf
