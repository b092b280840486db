// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "kdtree/kd_tree.h"
#include "scene/scene.h"

namespace sheaf::test {

/// A tree split at the middle of the longest side down to four triangles; triangles go by their
/// boxes.
class MiddleSplitTree {
 public:
  explicit MiddleSplitTree(const Scene& scene) : scene_(scene) {
    std::vector<std::uint32_t> all(scene.triangles.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    tree.bounds = scene.bounds;
    split(all, scene.bounds, 0);
  }
  KdTree tree;

 private:
  void split(const std::vector<std::uint32_t>& triangles, const Box& box, int depth) {
    const std::size_t index = tree.nodes.size();
    tree.nodes.emplace_back();
    if (triangles.size() <= 4 || depth == 12) {
      const auto first = static_cast<std::uint32_t>(tree.leaf_triangles.size());
      tree.nodes[index] = KdNode::leaf(first, static_cast<std::uint32_t>(triangles.size()));
      tree.leaf_triangles.insert(tree.leaf_triangles.end(), triangles.begin(), triangles.end());
      return;
    }
    const Vec3 e = box.extent();
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : (e.y >= e.z ? 1 : 2);
    const float plane = 0.5F * (box.lo[axis] + box.hi[axis]);
    std::vector<std::uint32_t> left;
    std::vector<std::uint32_t> right;
    for (const std::uint32_t t : triangles) {
      float lo = std::numeric_limits<float>::infinity();
      float hi = -lo;
      for (const std::uint32_t vertex : scene_.triangles[t]) {
        lo = std::min(lo, scene_.positions[vertex][axis]);
        hi = std::max(hi, scene_.positions[vertex][axis]);
      }
      if (lo <= plane) left.push_back(t);
      if (hi > plane) right.push_back(t);
    }
    Box left_box = box;
    Box right_box = box;
    left_box.hi[axis] = plane;
    right_box.lo[axis] = plane;
    split(left, left_box, depth + 1);
    tree.nodes[index] = KdNode::inner(axis, plane, static_cast<std::uint32_t>(tree.nodes.size()));
    split(right, right_box, depth + 1);
  }

  const Scene& scene_;
};

}  // namespace sheaf::test
