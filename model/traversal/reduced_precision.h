// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/box.h"
#include "geometry/ray.h"
#include "kdtree/kd_tree.h"
#include "traversal/interval_bounds.h"
#include "traversal/trace.h"

namespace sheaf {

/// An experiment: single-ray traversal with split planes and rays in fewer bits. A number that is
/// stored rounded stands for all that are stored alike, and a node is visited if any of these
/// would lead a ray there. Leaves are tested with the ray in full precision. So no hit is lost;
/// what fewer bits cost is steps and tests.
enum class Encoding : std::uint8_t { kFloat, kHalf, kFixed };

struct NumberFormat {
  const char* name;
  Encoding encoding;
  int bits;
};
inline constexpr NumberFormat kFullPrecision{"float", Encoding::kFloat, 32};
inline constexpr std::array kReducedFormats{
    NumberFormat{"half", Encoding::kHalf, 16}, NumberFormat{"fixed 16", Encoding::kFixed, 16},
    NumberFormat{"fixed 12", Encoding::kFixed, 12}, NumberFormat{"fixed 8", Encoding::kFixed, 8}};

/// All that is stored as `value` is: `value` itself (float), what rounds to the same half, or one
/// of the 2^bits equal cells of `space`. Without end beyond the largest half and beyond `space`.
/// Contains `value`, which is not NaN.
[[nodiscard]] Range stored_alike(const NumberFormat& format, float value, const Range& space);

/// What is stored how.
struct ReducedPrecision {
  NumberFormat planes = kFullPrecision;  ///< fixed: over the tree's bounds
  /// Origins and directions, each with its signs beside it. half: origin and inverse direction;
  /// fixed: the origin over `space`, and the direction over [-1, 1].
  NumberFormat rays = kFullPrecision;
  Box space;  ///< where rays start; an origin outside might be anywhere farther out
};

/// What a ray met, as RayPacket says it, and what that took. Of a shadow ray only whether.
struct ReducedTrace {
  std::uint32_t triangle = kNoHit;
  float t = 0.0F, u = 0.0F, v = 0.0F;
  std::uint64_t steps = 0;  ///< inner nodes visited
  std::uint64_t tests = 0;  ///< triangles tested
};

/// Traces a ray alone. In full precision it takes the very steps of TraversalScheme::kSingle.
[[nodiscard]] ReducedTrace trace_reduced(const ReducedPrecision& precision, const KdTree& tree,
                                         const std::vector<TriangleRecord>& triangles,
                                         const Ray& ray);

/// Walks to the leaves in the ray's order. `visit` is given a leaf's node number, and returns
/// beyond which t nothing is wanted any more. Returns the number of inner nodes visited.
std::uint64_t walk_reduced(const ReducedPrecision& precision, const KdTree& tree, const Ray& ray,
                           const std::function<float(std::uint32_t leaf)>& visit);

}  // namespace sheaf
