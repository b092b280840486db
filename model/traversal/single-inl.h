// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Included once for every instruction set; see hwy/foreach_target.h.
#if defined(SHEAF_TRAVERSAL_SINGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEAF_TRAVERSAL_SINGLE_INL_H_
#undef SHEAF_TRAVERSAL_SINGLE_INL_H_
#else
#define SHEAF_TRAVERSAL_SINGLE_INL_H_
#endif

#include <hwy/cache_control.h>

#include <limits>

#include "traversal/packed_rays.h"
#include "traversal/recorder.h"
#include "traversal/simd-inl.h"
#include "traversal/trace.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

/// One lane's walk through the tree, or through a part of it. Does the very arithmetic of
/// MaskedCursor, so that a ray fares the same in either.
class SingleCursor {
 public:
  SingleCursor(const KdTree& tree, const TriangleRecord* triangles, PackedRays& rays,
               std::size_t lane)
      : nodes_(tree.nodes.data()),
        leaf_triangles_(tree.leaf_triangles.data()),
        triangles_(triangles),
        rays_(rays),
        lane_(lane),
        any_hit_(((rays.any_hit >> lane) & 1U) != 0),
        limit_(rays.limit[lane]) {
    for (std::size_t a = 0; a < 3; ++a) {
      const float inverse = rays.axis[a].inverse[lane];
      const std::uint32_t negative = std::bit_cast<std::uint32_t>(inverse) >> 31;
      axis_[a] = {rays.axis[a].near_origin[lane], rays.axis[a].far_origin[lane], inverse,
                  0U - negative};
    }
  }

  /// Walks what lies below `node` within [enter, leave], which is not empty.
  template <class Recorder>
  HWY_INLINE void walk(std::uint32_t node_index, float enter, float leave, Recorder& recorder) {
    Postponed* top = stack_.data();
    for (;;) {
      KdNode node = nodes_[node_index];
      while (!node.is_leaf()) {
        recorder.inner(node_index);
        const Axis axis = axis_[static_cast<std::size_t>(node.axis())];
        const std::uint32_t left = node_index + 1;
        const std::uint32_t swap = (left ^ node.right_child()) & axis.negative;
        const std::uint32_t near = left ^ swap;
        const std::uint32_t far = node.right_child() ^ swap;
        hwy::Prefetch(nodes_ + far);
        const float near_until = (node.split() - axis.near_origin) * axis.inverse;
        const float far_from = (node.split() - axis.far_origin) * axis.inverse;
        // The interval is not empty, and a distance that is NaN skips nothing. Whether a far child
        // waits behind a near one is hard to predict: stored in any case, it is kept without a
        // jump.
        const std::uint32_t skips_near = near_until < enter ? 1 : 0;
        const std::uint32_t skips_far = far_from > leave ? 1 : 0;
        *top = {far, far_from > enter ? far_from : enter, leave};
        if (skips_near == 0) {
          if (skips_far == 0) ++top;
          node_index = near;
          leave = near_until < leave ? near_until : leave;
        } else {
          node_index = far;
        }
        node = nodes_[node_index];
      }
      recorder.leaf();
      recorder.leaf_done(node_index, test_leaf(node, recorder));
      do {
        if (top == stack_.data()) return;
        --top;
        leave = top->leave < limit_ ? top->leave : limit_;
      } while (!(top->enter <= leave));
      node_index = top->node;
      enter = top->enter;
    }
  }

 private:
  struct Axis {
    float near_origin, far_origin, inverse;
    std::uint32_t negative;  ///< all bits set if the direction is negative
  };
  struct Postponed {
    std::uint32_t node;
    float enter, leave;
  };

  /// Returns how many triangles were tested.
  template <class Recorder>
  HWY_INLINE std::uint32_t test_leaf(const KdNode node, Recorder& recorder) {
    const std::uint32_t count = node.count();
    if (count == 0) return 0;
    const std::uint32_t* const list = leaf_triangles_ + node.first();
    const ShearedRay ray = rays_.sheared_ray(lane_);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t triangle = list[i];
      TriangleHit hit;
      if (hit_sheared(ray.shear(&triangles_[triangle].a.x), hit) && accept(triangle, hit)) {
        recorder.triangles(i + 1);
        return i + 1;
      }
    }
    recorder.triangles(count);
    return count;
  }

  /// Whether the lane is done.
  HWY_INLINE bool accept(std::uint32_t triangle, const TriangleHit& hit) {
    const bool wins = hit.t < limit_ || (hit.t == limit_ && triangle < rays_.hit_triangle[lane_]);
    if (!(hit.t >= 0.0F && wins)) return false;
    rays_.has_hit |= LaneMask{1} << lane_;
    rays_.hit_t[lane_] = hit.t;
    rays_.hit_u[lane_] = hit.u;
    rays_.hit_v[lane_] = hit.v;
    rays_.hit_triangle[lane_] = triangle;
    limit_ = any_hit_ ? -std::numeric_limits<float>::infinity() : hit.t;
    rays_.limit[lane_] = limit_;
    return any_hit_;
  }

  const KdNode* const nodes_;
  const std::uint32_t* const leaf_triangles_;
  const TriangleRecord* const triangles_;
  PackedRays& rays_;
  const std::size_t lane_;
  const bool any_hit_;
  float limit_;
  std::array<Axis, 3> axis_;
  std::array<Postponed, kMaxKdDepth + 1> stack_;
};

template <class Recorder>
HWY_NOINLINE void walk_lane(const KdTree& tree, const TriangleRecord* triangles, PackedRays& rays,
                            std::size_t lane, std::uint32_t node, float enter, float leave,
                            Recorder& recorder) {
  LaneRecorder<Recorder> lane_recorder(recorder, lane);
  SingleCursor(tree, triangles, rays, lane).walk(node, enter, leave, lane_recorder);
}

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
