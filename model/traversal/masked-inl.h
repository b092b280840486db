// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Included once for every instruction set; see hwy/foreach_target.h.
#if defined(SHEAF_TRAVERSAL_MASKED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEAF_TRAVERSAL_MASKED_INL_H_
#undef SHEAF_TRAVERSAL_MASKED_INL_H_
#else
#define SHEAF_TRAVERSAL_MASKED_INL_H_
#endif

#include <hwy/cache_control.h>

#include "traversal/packet_triangle-inl.h"
#include "traversal/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

/// The walk of rays of one direction-sign configuration together, in `kGroups` vectors. A lane
/// takes part in a node while its interval [enter, leave] is not empty, which is exactly while the
/// ray traced alone would visit the node; the masks are only the intervals' image in bits.
template <std::size_t kGroups>
class MaskedCursor {
 public:
  /// `sign` is the direction-sign configuration of the rays in `members`, bit a for axis a.
  MaskedCursor(const KdTree& tree, const TriangleRecord* triangles, PackedRays& rays,
               LaneMask members, unsigned sign)
      : tree_(tree),
        nodes_(tree.nodes.data()),
        leaf_triangles_(tree.leaf_triangles.data()),
        triangles_(triangles),
        rays_(rays),
        members_(members),
        sign_(sign),
        shared_axis_(shared_axis(members, rays)) {}

  template <class Recorder>
  HWY_INLINE void walk(Recorder& recorder) {
    Postponed* top = stack_.data();
    State now = start();
    while (now.lanes != 0) {
      if ((now.lanes & (now.lanes - 1)) == 0) {
        walk_alone(now, recorder);
        now = pop(top);
        continue;
      }
      const KdNode node = nodes_[now.node];
      if (node.is_leaf()) {
        recorder.leaf(now.lanes);
        recorder.leaf_done(now.node, test_leaf(node, now.lanes, recorder));
        now = pop(top);
      } else {
        recorder.inner(now.node, now.lanes);
        descend(node, now, top);
      }
    }
  }

 private:
  /// Where the walk stands. Intervals of groups without a lane in `lanes` mean nothing.
  struct State {
    std::array<FloatVec, kGroups> enter;
    std::array<FloatVec, kGroups> leave;
    LaneMask lanes;
    std::uint32_t node;
  };
  using Postponed = State;

  static HWY_INLINE bool skip(LaneMask lanes, std::size_t group) {
    return kGroups > 1 && group_bits(lanes, group) == 0;
  }

  HWY_INLINE State start() const {
    State state;
    state.lanes = 0;
    state.node = 0;
    for (std::size_t g = 0; g < kGroups; ++g) {
      state.enter[g] = hn::Zero(FloatTag());
      state.leave[g] = hn::Set(FloatTag(), -1.0F);
      if (skip(members_, g)) continue;
      state.enter[g] = load(rays_.enter, g);
      state.leave[g] =
          hn::IfThenElse(mask_of(group_bits(members_, g)), load(rays_.leave, g), state.leave[g]);
      state.lanes |= bits_of(hn::Le(state.enter[g], state.leave[g])) << (g * kGroupLanes);
    }
    return state;
  }

  /// From an inner node to a child that a lane visits, the near one if there is a choice.
  HWY_INLINE void descend(const KdNode node, State& now, Postponed*& top) const {
    const auto a = static_cast<std::size_t>(node.axis());
    const PackedRays::Axis& axis = rays_.axis[a];
    const std::uint32_t left = now.node + 1;
    const std::uint32_t swap = (left ^ node.right_child()) & (0U - ((sign_ >> a) & 1U));
    const std::uint32_t near = left ^ swap;
    const std::uint32_t far = node.right_child() ^ swap;
    hwy::Prefetch(nodes_ + far);
    const FloatVec split = hn::Set(FloatTag(), node.split());
    std::array<FloatVec, kGroups> near_leave = now.leave;
    std::array<FloatVec, kGroups> far_enter = now.enter;
    LaneMask near_lanes = 0;
    LaneMask far_lanes = 0;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (skip(now.lanes, g)) continue;
      const FloatVec inverse = load(axis.inverse, g);
      const FloatVec near_until = hn::Mul(hn::Sub(split, load(axis.near_origin, g)), inverse);
      const FloatVec far_from = hn::Mul(hn::Sub(split, load(axis.far_origin, g)), inverse);
      near_leave[g] = min_unless_nan(near_until, now.leave[g]);
      far_enter[g] = max_unless_nan(far_from, now.enter[g]);
      near_lanes |= bits_of(hn::Le(now.enter[g], near_leave[g])) << (g * kGroupLanes);
      far_lanes |= bits_of(hn::Le(far_enter[g], now.leave[g])) << (g * kGroupLanes);
    }
    if (near_lanes == 0) {  // then the intervals stay what they are
      now.node = far;
      now.lanes = far_lanes;
      return;
    }
    if (far_lanes != 0) *top++ = {far_enter, now.leave, far_lanes, far};
    now = {now.enter, near_leave, near_lanes, near};
  }

  /// To the last node put off that a lane still has to visit.
  HWY_INLINE State pop(Postponed*& top) {
    State next;
    do {
      if (top == stack_.data()) {
        next.lanes = 0;
        break;
      }
      next = *--top;
      const LaneMask lanes = next.lanes;
      next.lanes = 0;
      for (std::size_t g = 0; g < kGroups; ++g) {
        if (skip(lanes, g)) continue;
        next.leave[g] = hn::Min(next.leave[g], load(rays_.limit, g));
        next.lanes |= bits_of(hn::Le(next.enter[g], next.leave[g])) << (g * kGroupLanes);
      }
    } while (next.lanes == 0);
    return next;
  }

  /// A lane left alone goes on in scalars, which are faster for one ray.
  template <class Recorder>
  HWY_INLINE void walk_alone(const State& now, Recorder& recorder) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(now.lanes));
    alignas(64) Lanes<float> enter;
    alignas(64) Lanes<float> leave;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (skip(now.lanes, g)) continue;
      store(now.enter[g], enter, g);
      store(now.leave[g], leave, g);
    }
    walk_lane(tree_, triangles_, rays_, lane, now.node, enter[lane], leave[lane], recorder);
  }

  /// Returns how many triangles were tested.
  template <class Recorder>
  HWY_INLINE std::uint32_t test_leaf(const KdNode node, LaneMask lanes, Recorder& recorder) {
    const std::uint32_t count = node.count();
    const std::uint32_t* const list = leaf_triangles_ + node.first();
    for (std::uint32_t i = 0; i < count; ++i) {
      recorder.triangle(lanes);
      const std::uint32_t triangle = list[i];
      const float* const corners = &triangles_[triangle].a.x;
      for (std::size_t g = 0; g < kGroups; ++g) {
        if (skip(lanes, g)) continue;
        const LaneMask ended =
            test_triangle(corners, triangle, shared_axis_, g, group_bits(lanes, g), rays_);
        lanes &= ~(ended << (g * kGroupLanes));
      }
      if (lanes == 0) return i + 1;
    }
    return count;
  }

  const KdTree& tree_;
  const KdNode* const nodes_;
  const std::uint32_t* const leaf_triangles_;
  const TriangleRecord* const triangles_;
  PackedRays& rays_;
  const LaneMask members_;
  const unsigned sign_;
  const SharedAxis shared_axis_;
  std::array<Postponed, kMaxKdDepth> stack_;
};

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
