// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "traversal/reduced_precision.h"

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/watertight.h"

namespace sheaf {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A unit vector's components with what normalizing it rounds.
constexpr float kLongest = 1.0F + 0x1p-20F;

Range halves_alike(float value) {
  const float stored{Imath::half(value)};
  if (std::isinf(stored)) {
    constexpr float kLargest = 65504.0F;
    return stored > 0.0F ? Range{kLargest, kInfinity} : Range{-kInfinity, -kLargest};
  }
  const float ulp = std::ldexp(1.0F, std::max(std::ilogb(stored), -14) - 10);
  return {stored - 0.5F * ulp, stored + 0.5F * ulp};
}

// The writer takes the cell whose ends, rounded as they are, lie around the value.
Range cell_of(float value, const Range& space, int bits) {
  if (value < space.lo) return {-kInfinity, space.lo};
  if (value > space.hi) return {space.hi, kInfinity};
  const double extent = double{space.hi} - double{space.lo};
  if (extent == 0.0) return {value, value};
  const double cells = std::ldexp(1.0, bits);
  const double share = (double{value} - double{space.lo}) / extent;
  const double cell = std::min(std::floor(share * cells), cells - 1.0);
  const auto end = [&](double index) {
    return static_cast<float>(double{space.lo} + index / cells * extent);
  };
  return {std::min(end(cell), value), std::max(end(cell + 1.0), value)};
}

/// 1 / x of numbers of one sign, without the sign.
Range inverse_of(const Range& x) {
  return {1.0F / x.hi, 1.0F / std::max(x.lo, 0.0F)};
}

Range inverse_direction(const NumberFormat& format, float direction) {
  const Range length{std::fabs(direction), std::fabs(direction)};
  const int magnitude_bits = format.bits - 1;
  const Range inverse = format.encoding == Encoding::kFixed
                            ? inverse_of(cell_of(length.lo, {0.0F, kLongest}, magnitude_bits))
                            : stored_alike(format, inverse_of(length).lo, kAnything);
  return std::signbit(direction) ? Range{-inverse.hi, -inverse.lo} : inverse;
}

/// A ray as set_up_planes() prepares it (ray_setup-inl.h has the reasons), with all that its stored
/// numbers stand for. The same operations in the same order: rounding is monotonic, so that what
/// the exact ray would compute lies within.
struct StoredRay {
  struct Axis {
    Range near_origin, far_origin, inverse;
    bool negative;
    [[nodiscard]] float near_until(const Range& plane) const {
      return product({plane.lo - near_origin.hi, plane.hi - near_origin.lo}, inverse).hi;
    }
    [[nodiscard]] float far_from(const Range& plane) const {
      return product({plane.lo - far_origin.hi, plane.hi - far_origin.lo}, inverse).lo;
    }
  };
  std::array<Axis, 3> axis;
  float enter = 0.0F, leave;  ///< of the tree's bounds

  StoredRay(const ReducedPrecision& precision, const Box& bounds, const Ray& ray)
      : leave(ray.t_max) {
    constexpr float kHalfUlp = 0x1p-24F;
    const Vec3 reach = glm::max(glm::abs(bounds.lo - ray.origin), glm::abs(bounds.hi - ray.origin));
    const float reach_z = reach[static_cast<int>(ShearedRay(ray.origin, ray.direction).z)];
    float sum = 0.0F;
    for (int a = 0; a < 3; ++a) {
      const float error =
          6.0F * kHalfUlp * (reach[a] + reach_z) + 2.0F * kHalfUlp * std::fabs(ray.origin[a]);
      const float shift = std::copysign(error, ray.direction[a]);
      const Range origin = stored_alike(precision.rays, ray.origin[a],
                                        {precision.space.lo[a], precision.space.hi[a]});
      const bool negative = std::signbit(ray.direction[a]);
      Axis& to = axis[static_cast<std::size_t>(a)];
      to = {{origin.lo - shift, origin.hi - shift},
            {origin.lo + shift, origin.hi + shift},
            inverse_direction(precision.rays, ray.direction[a]),
            negative};
      const float first = negative ? bounds.hi[a] : bounds.lo[a];
      const float last = negative ? bounds.lo[a] : bounds.hi[a];
      enter = std::max(enter, to.far_from({first, first}));
      leave = std::min(leave, to.near_until({last, last}));
      sum += ray.origin[a] + ray.direction[a];
    }
    if (!std::isfinite(sum + enter)) leave = -1.0F;  // meets nothing
  }
};

/// Tests the triangles of leaves as SingleCursor does.
class LeafTest {
 public:
  LeafTest(const KdTree& tree, const std::vector<TriangleRecord>& triangles, const Ray& ray)
      : tree_(tree),
        triangles_(triangles),
        any_hit_(ray.tag.kind == RayKind::kShadow),
        ray_(ray.origin, ray.direction),
        limit_(std::min(ray.t_max, std::numeric_limits<float>::max())),
        nearest_(any_hit_ ? 0 : kNoHit) {}

  /// Returns the limit from then on.
  float test(const KdNode leaf, ReducedTrace& found) {
    for (std::uint32_t i = 0; i < leaf.count(); ++i) {
      const std::uint32_t triangle = tree_.leaf_triangles[leaf.first() + i];
      ++found.tests;
      TriangleHit hit;
      if (!hit_sheared(ray_.shear(&triangles_[triangle].a.x), hit)) continue;
      const bool wins = hit.t < limit_ || (hit.t == limit_ && triangle < nearest_);
      if (!(hit.t >= 0.0F && wins)) continue;
      found.triangle = nearest_ = triangle;
      found.t = limit_ = hit.t;
      found.u = hit.u;
      found.v = hit.v;
      if (any_hit_) return -kInfinity;
    }
    return limit_;
  }

 private:
  const KdTree& tree_;
  const std::vector<TriangleRecord>& triangles_;
  const bool any_hit_;
  const ShearedRay ray_;
  float limit_;
  std::uint32_t nearest_;
};

}  // namespace

Range stored_alike(const NumberFormat& format, float value, const Range& space) {
  if (format.encoding == Encoding::kHalf) return halves_alike(value);
  if (format.encoding == Encoding::kFixed) return cell_of(value, space, format.bits);
  return {value, value};
}

std::uint64_t walk_reduced(const ReducedPrecision& precision, const KdTree& tree, const Ray& ray,
                           const std::function<float(std::uint32_t leaf)>& visit) {
  struct Part {
    std::uint32_t node;
    float enter, leave;
  };
  const StoredRay stored(precision, tree.bounds, ray);
  std::array<Part, kMaxKdDepth + 1> stack;
  std::size_t size = 0;
  std::uint64_t steps = 0;
  Part now{0, stored.enter, stored.leave};
  while (now.enter <= now.leave) {
    const KdNode node = tree.nodes[now.node];
    if (!node.is_leaf()) {
      ++steps;
      const int a = node.axis();
      const StoredRay::Axis& axis = stored.axis[static_cast<std::size_t>(a)];
      const Range plane =
          stored_alike(precision.planes, node.split(), {tree.bounds.lo[a], tree.bounds.hi[a]});
      const std::uint32_t left = now.node + 1;
      const std::uint32_t far = axis.negative ? left : node.right_child();
      const float near_leave = std::min(axis.near_until(plane), now.leave);
      const float far_enter = std::max(axis.far_from(plane), now.enter);
      if (now.enter > near_leave) {
        now.node = far;
        continue;
      }
      if (far_enter <= now.leave) stack[size++] = {far, far_enter, now.leave};
      now = {axis.negative ? node.right_child() : left, now.enter, near_leave};
      continue;
    }
    const float limit = visit(now.node);
    do {
      if (size == 0) return steps;
      now = stack[--size];
      now.leave = std::min(now.leave, limit);
    } while (now.enter > now.leave);
  }
  return steps;
}

ReducedTrace trace_reduced(const ReducedPrecision& precision, const KdTree& tree,
                           const std::vector<TriangleRecord>& triangles, const Ray& ray) {
  ReducedTrace found;
  found.t = ray.t_max;
  LeafTest leaves(tree, triangles, ray);
  found.steps = walk_reduced(precision, tree, ray, [&](std::uint32_t leaf) {
    return leaves.test(tree.nodes[leaf], found);
  });
  return found;
}

}  // namespace sheaf
