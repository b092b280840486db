// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Included once for every instruction set; see hwy/foreach_target.h.
#if defined(SHEAF_TRAVERSAL_SINGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEAF_TRAVERSAL_SINGLE_INL_H_
#undef SHEAF_TRAVERSAL_SINGLE_INL_H_
#else
#define SHEAF_TRAVERSAL_SINGLE_INL_H_
#endif

#include <limits>

#include "traversal/pass_rays.h"
#include "traversal/simd-inl.h"
#include "traversal/trace.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

/// One lane's walk through the tree, or through a part of it. Does the very arithmetic of
/// MaskedCursor, so that a ray fares the same in either.
class SingleCursor {
 public:
  SingleCursor(const KdTree& tree, const TriangleRecord* triangles, PassRays& rays,
               std::size_t lane)
      : nodes_(tree.nodes.data()),
        leaf_triangles_(tree.leaf_triangles.data()),
        triangles_(triangles),
        rays_(rays),
        lane_(lane),
        any_hit_(((rays.any_hit >> lane) & 1U) != 0) {
    for (std::size_t a = 0; a < 3; ++a) {
      axis_[a] = {rays.axis[a].near_origin[lane], rays.axis[a].far_origin[lane],
                  rays.axis[a].inverse[lane],
                  std::bit_cast<std::uint32_t>(rays.axis[a].inverse[lane]) >> 31};
    }
  }

  /// Walks what lies below `node` within [enter, leave], which is not empty.
  template <class Recorder>
  HWY_INLINE void walk(std::uint32_t node, float enter, float leave, Recorder& recorder) {
    depth_ = 0;
    node_ = node;
    enter_ = enter;
    leave_ = leave;
    do {
      step(recorder);
    } while (node_ != kNowhere);
  }

 private:
  static constexpr std::uint32_t kNowhere = ~std::uint32_t{0};
  struct Axis {
    float near_origin, far_origin, inverse;
    std::uint32_t negative;
  };
  struct Postponed {
    std::uint32_t node;
    float enter, leave;
  };

  template <class Recorder>
  HWY_INLINE void step(Recorder& recorder) {
    const KdNode node = nodes_[node_];
    if (node.is_leaf()) {
      recorder.leaf(LaneMask{1} << lane_);
      recorder.leaf_done(node_, test_leaf(node, recorder));
      pop();
    } else {
      recorder.inner(node_, LaneMask{1} << lane_);
      descend(node);
    }
  }

  HWY_INLINE void descend(const KdNode node) {
    const Axis& axis = axis_[static_cast<std::size_t>(node.axis())];
    const std::uint32_t children[2] = {node_ + 1, node.right_child()};
    const std::uint32_t near = children[axis.negative];
    const std::uint32_t far = children[axis.negative ^ 1U];
    const float near_until = (node.split() - axis.near_origin) * axis.inverse;
    const float far_from = (node.split() - axis.far_origin) * axis.inverse;
    const float near_leave = near_until < leave_ ? near_until : leave_;
    const float far_enter = far_from > enter_ ? far_from : enter_;
    const bool visit_far = far_enter <= leave_;
    if (enter_ <= near_leave) {
      if (visit_far) stack_[depth_++] = {far, far_enter, leave_};
      node_ = near;
      leave_ = near_leave;
    } else {
      node_ = far;
      enter_ = far_enter;
    }
  }

  HWY_INLINE void pop() {
    const float limit = rays_.limit[lane_];
    while (depth_ > 0) {
      const Postponed& next = stack_[--depth_];
      const float leave = next.leave < limit ? next.leave : limit;
      if (next.enter <= leave) {
        node_ = next.node;
        enter_ = next.enter;
        leave_ = leave;
        return;
      }
    }
    node_ = kNowhere;
  }

  /// Returns how many triangles were tested.
  template <class Recorder>
  HWY_INLINE std::uint32_t test_leaf(const KdNode node, Recorder& recorder) {
    const std::uint32_t count = node.count();
    if (count == 0) return 0;
    const std::uint32_t* const list = leaf_triangles_ + node.first();
    const ShearedRay ray = rays_.sheared_ray(lane_);
    for (std::uint32_t i = 0; i < count; ++i) {
      recorder.triangle(LaneMask{1} << lane_);
      const std::uint32_t triangle = list[i];
      TriangleHit hit;
      if (hit_sheared(ray.shear(&triangles_[triangle].a.x), hit) && accept(triangle, hit)) {
        return i + 1;
      }
    }
    return count;
  }

  /// Whether the lane is done.
  HWY_INLINE bool accept(std::uint32_t triangle, const TriangleHit& hit) {
    const float limit = rays_.limit[lane_];
    const bool wins = hit.t < limit || (hit.t == limit && triangle < rays_.hit_triangle[lane_]);
    if (!(hit.t >= 0.0F && wins)) return false;
    rays_.has_hit |= LaneMask{1} << lane_;
    rays_.hit_t[lane_] = hit.t;
    rays_.hit_u[lane_] = hit.u;
    rays_.hit_v[lane_] = hit.v;
    rays_.hit_triangle[lane_] = triangle;
    rays_.limit[lane_] = any_hit_ ? -std::numeric_limits<float>::infinity() : hit.t;
    return any_hit_;
  }

  const KdNode* const nodes_;
  const std::uint32_t* const leaf_triangles_;
  const TriangleRecord* const triangles_;
  PassRays& rays_;
  const std::size_t lane_;
  const bool any_hit_;
  std::array<Axis, 3> axis_;
  std::uint32_t node_ = kNowhere;
  float enter_ = 0.0F;
  float leave_ = 0.0F;
  std::size_t depth_ = 0;
  std::array<Postponed, kMaxKdDepth> stack_;
};

template <class Recorder>
HWY_NOINLINE void walk_lane(const KdTree& tree, const TriangleRecord* triangles, PassRays& rays,
                            std::size_t lane, std::uint32_t node, float enter, float leave,
                            Recorder& recorder) {
  SingleCursor(tree, triangles, rays, lane).walk(node, enter, leave, recorder);
}

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
