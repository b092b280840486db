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

#include <bit>

#include "traversal/leaf_tester-inl.h"
#include "traversal/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

/// The walk of rays together, in `kGroups` vectors. A lane takes part in a node while its interval
/// [enter, leave] is not empty; the masks are only the intervals' image in bits.
///
/// With rays of one direction-sign configuration a lane takes part exactly while the ray traced
/// alone would visit the node. With `kMixedSigns` (omni: Reshetov, "Omnidirectional ray tracing
/// traversal algorithm for kd-trees", 2006) each lane gives its near child's interval to the left
/// or to the right child as its own sign says, and the packet goes first where most of the lanes
/// that visit both would. The others visit their far child first. They may go on only with what
/// lies before the hit found there, never end with it: every lane is culled by itself when a node
/// is popped, and nothing else ends a walk.
template <std::size_t kGroups, bool kMixedSigns>
class MaskedCursor {
 public:
  /// `sign`: the direction-sign configuration of the rays in `members`, bit a for axis a;
  /// meaningless with kMixedSigns.
  MaskedCursor(const KdTree& tree, const TriangleRecord* triangles, PackedRays& rays,
               LaneMask members, unsigned sign)
      : tree_(tree),
        nodes_(tree.nodes.data()),
        triangles_(triangles),
        rays_(rays),
        members_(members),
        sign_(sign),
        leaves_(tree, triangles, rays, members) {
    if constexpr (kMixedSigns) find_signs();
  }

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
        recorder.leaf_done(now.node, leaves_.test(node, now.lanes, recorder));
        now = pop(top);
      } else {
        recorder.inner(now.node, now.lanes);
        if constexpr (kMixedSigns) {
          descend_mixed(node, State(now), now, top);
        } else {
          descend(node, now, top);
        }
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

  HWY_INLINE State start() const {
    State state;
    state.lanes = 0;
    state.node = 0;
    for (std::size_t g = 0; g < kGroups; ++g) {
      state.enter[g] = hn::Zero(FloatTag());
      state.leave[g] = hn::Set(FloatTag(), -1.0F);
      if (skip<kGroups>(members_, g)) continue;
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
      if (skip<kGroups>(now.lanes, g)) continue;
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

  void find_signs() {
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t g = 0; g < kGroups; ++g) {
        if (skip<kGroups>(members_, g)) continue;
        const FloatVec one =
            hn::CopySign(hn::Set(FloatTag(), 1.0F), load(rays_.axis[a].inverse, g));
        negative_[a] |= bits_of(hn::Lt(one, hn::Zero(FloatTag()))) << (g * kGroupLanes);
      }
    }
  }

  /// From an inner node to a child that a lane visits; of both first where most begin.
  HWY_INLINE void descend_mixed(const KdNode node, const State& from, State& now,
                                Postponed*& top) const {
    const auto a = static_cast<std::size_t>(node.axis());
    const PackedRays::Axis& axis = rays_.axis[a];
    const FloatVec split = hn::Set(FloatTag(), node.split());
    State left{from.enter, from.leave, 0, from.node + 1};
    State right{from.enter, from.leave, 0, node.right_child()};
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (skip<kGroups>(from.lanes, g)) continue;
      const FloatVec inverse = load(axis.inverse, g);
      const FloatVec near_until = hn::Mul(hn::Sub(split, load(axis.near_origin, g)), inverse);
      const FloatVec far_from = hn::Mul(hn::Sub(split, load(axis.far_origin, g)), inverse);
      const FloatVec near_leave = min_unless_nan(near_until, from.leave[g]);
      const FloatVec far_enter = max_unless_nan(far_from, from.enter[g]);
      const FloatMask negative = mask_of(group_bits(negative_[a], g));
      left.enter[g] = hn::IfThenElse(negative, far_enter, from.enter[g]);
      left.leave[g] = hn::IfThenElse(negative, from.leave[g], near_leave);
      right.enter[g] = hn::IfThenElse(negative, from.enter[g], far_enter);
      right.leave[g] = hn::IfThenElse(negative, near_leave, from.leave[g]);
      left.lanes |= bits_of(hn::Le(left.enter[g], left.leave[g])) << (g * kGroupLanes);
      right.lanes |= bits_of(hn::Le(right.enter[g], right.leave[g])) << (g * kGroupLanes);
    }
    const LaneMask both = left.lanes & right.lanes;
    const bool right_first = 2 * std::popcount(both & negative_[a]) > std::popcount(both);
    const State& first = right_first ? right : left;
    const State& second = right_first ? left : right;
    if (first.lanes != 0 && second.lanes != 0) *top++ = second;
    now = first.lanes != 0 ? first : second;
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
        if (skip<kGroups>(lanes, g)) continue;
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
      if (skip<kGroups>(now.lanes, g)) continue;
      store(now.enter[g], enter, g);
      store(now.leave[g], leave, g);
    }
    walk_lane(tree_, triangles_, rays_, lane, now.node, enter[lane], leave[lane], recorder);
  }

  const KdTree& tree_;
  const KdNode* const nodes_;
  const TriangleRecord* const triangles_;
  PackedRays& rays_;
  const LaneMask members_;
  const unsigned sign_;
  const LeafTester<kGroups> leaves_;
  std::array<LaneMask, 3> negative_{};  ///< by axis: lanes of negative direction; kMixedSigns only
  std::array<Postponed, kMaxKdDepth> stack_;
};

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
