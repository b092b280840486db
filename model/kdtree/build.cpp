// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/build.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/errors.h"
#include "base/huge_pages.h"
#include "kdtree/event_sort.h"
#include "kdtree/mesh_view.h"
#include "kdtree/parallel_build.h"
#include "kdtree/split_event.h"
#include "kdtree/subtree_builder.h"

namespace sheaf {
namespace {

// Two equal corners have equal images under any projection, so the edge functions of a ray cancel
// exactly and the triangle is never hit. Other triangles without area stay: a rounded test might
// hit them, and the tree must not decide that.
bool can_be_hit(const std::array<Vec3, 3>& corners) {
  return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

int depth_limit(const KdBuildOptions& options, std::size_t num_triangles) {
  if (options.max_depth > 0) return std::min(options.max_depth, kMaxKdDepth);
  const double limit =
      8.0 + 1.3 * std::log2(static_cast<double>(std::max<std::size_t>(num_triangles, 1)));
  return std::min(static_cast<int>(limit), kMaxKdDepth);
}

Box corner_box(const std::array<Vec3, 3>& corners) {
  Box box;
  for (const Vec3& corner : corners) box.add(corner);
  return box;
}

// The box of all triangles; counts those that can be hit.
Box measure(const MeshView& mesh, std::size_t& num_hittable) {
  Box bounds;
  num_hittable = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corners = mesh.corners(i);
    for (const Vec3& corner : corners) bounds.add(corner);
    num_hittable += can_be_hit(corners) ? 1U : 0U;
  }
  return bounds;
}

// Fills lists that were laid out for the triangles that can be hit.
void collect_events(const MeshView& mesh, NodeEvents& events) {
  std::array<std::size_t, 3> count{};
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corners = mesh.corners(i);
    if (!can_be_hit(corners)) continue;
    const Box box = corner_box(corners);
    for (std::size_t k = 0; k < 3; ++k) {
      const float lo = box.lo[static_cast<int>(k)];
      const float hi = box.hi[static_cast<int>(k)];
      SplitEvent* const list = events.axis[k].data();
      if (lo == hi) {
        list[count[k]++] = make_event(lo, EventKind::kPlanar, i);
      } else {
        list[count[k]++] = make_event(lo, EventKind::kStart, i);
        list[count[k]++] = make_event(hi, EventKind::kEnd, i);
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k) events.axis[k] = events.axis[k].first(count[k]);
}

PendingNode make_root(const MeshView& mesh, const Box& bounds, std::size_t num_hittable,
                      SplitEvent* memory) {
  PendingNode root;
  root.cell = bounds;
  root.events = lay_node_events(memory, num_hittable);
  collect_events(mesh, root.events);
  const std::size_t room = 2 * num_hittable;
  const auto scratch = std::make_unique_for_overwrite<SplitEvent[]>(room);
  for (auto& list : root.events.axis) sort_events(list, {scratch.get(), room});
  return root;
}

}  // namespace

KdTree build_kd_tree(std::span<const Vec3> positions,
                     std::span<const std::array<std::uint32_t, 3>> triangles,
                     const KdBuildOptions& options) {
  if (triangles.size() > kMaxEventTriangle) {
    throw Error(ExitCode::kScene, "scene: more than 2^30 - 1 triangles; split the scene");
  }
  const MeshView mesh{positions, triangles};
  const SahCosts costs{options.traversal_cost, options.intersection_cost, options.empty_bonus};
  KdTree tree;
  std::size_t num_hittable = 0;
  tree.bounds = measure(mesh, num_hittable);
  const int max_depth = depth_limit(options, num_hittable);
  const std::size_t room = node_events_room(num_hittable);
  if (options.threads > 1) {
    auto memory = std::make_unique_for_overwrite<SplitEvent[]>(room);
    const PendingNode root = make_root(mesh, tree.bounds, num_hittable, memory.get());
    build_in_parallel(mesh, costs, max_depth, options.threads, root, std::move(memory), tree);
  } else {
    // More than most trees need. What stays unused is never touched and so takes no memory, while
    // growing step by step would hold two copies of the tree at once.
    reserve_on_huge_pages(tree.nodes, 12 * num_hittable + 1);
    reserve_on_huge_pages(tree.leaf_triangles, 12 * num_hittable);
    SubtreeBuilder builder(mesh, costs, max_depth);
    SplitEvent* const memory = builder.root_arena().allocate(room);
    builder.build(make_root(mesh, tree.bounds, num_hittable, memory), tree);
  }
  return tree;
}

}  // namespace sheaf
