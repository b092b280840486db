// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Included once for every instruction set; see hwy/foreach_target.h.
#if defined(SHEAF_TRAVERSAL_MASKED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEAF_TRAVERSAL_MASKED_INL_H_
#undef SHEAF_TRAVERSAL_MASKED_INL_H_
#else
#define SHEAF_TRAVERSAL_MASKED_INL_H_
#endif

#include "traversal/packet_triangle-inl.h"
#include "traversal/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

/// The walk of rays of one direction-sign configuration together, in `kGroups` vectors. A lane
/// takes part in a node while its interval [enter, leave] is not empty, which is exactly while the
/// ray traced alone would visit the node; the masks are only the intervals' image in bits.
/// Intervals of groups without a lane in the mask are not kept up to date.
template <std::size_t kGroups>
class MaskedCursor {
 public:
  MaskedCursor(const KdTree& tree, const TriangleRecord* triangles, PassRays& rays)
      : tree_(tree),
        nodes_(tree.nodes.data()),
        leaf_triangles_(tree.leaf_triangles.data()),
        triangles_(triangles),
        rays_(rays) {}

  template <class Recorder>
  HWY_INLINE void walk(Recorder& recorder) {
    depth_ = 0;
    node_ = 0;
    lanes_ = 0;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (g * kGroupLanes >= static_cast<std::size_t>(rays_.count)) break;
      enter_[g] = load(rays_.enter, g);
      leave_[g] = load(rays_.leave, g);
      lanes_ |= bits_of(hn::Le(enter_[g], leave_[g])) << (g * kGroupLanes);
    }
    while (lanes_ != 0) {
      if ((lanes_ & (lanes_ - 1)) == 0) {
        walk_alone(recorder);
      } else {
        step(recorder);
      }
    }
  }

 private:
  struct Postponed {
    std::array<FloatVec, kGroups> enter;
    std::array<FloatVec, kGroups> leave;
    LaneMask lanes;
    std::uint32_t node;
  };

  static bool skip(LaneMask lanes, std::size_t group) {
    return kGroups > 1 && group_bits(lanes, group) == 0;
  }

  template <class Recorder>
  HWY_INLINE void step(Recorder& recorder) {
    const KdNode node = nodes_[node_];
    if (node.is_leaf()) {
      recorder.leaf(lanes_);
      recorder.leaf_done(node_, test_leaf(node, recorder));
      pop();
    } else {
      recorder.inner(node_, lanes_);
      descend(node);
    }
  }

  HWY_INLINE void descend(const KdNode node) {
    const auto a = static_cast<std::size_t>(node.axis());
    const PassRays::Axis& axis = rays_.axis[a];
    const std::uint32_t children[2] = {node_ + 1, node.right_child()};
    const std::size_t negative = (rays_.sign >> a) & 1U;
    const std::uint32_t near = children[negative];
    const std::uint32_t far = children[negative ^ 1U];
    const FloatVec split = hn::Set(FloatTag(), node.split());
    std::array<FloatVec, kGroups> near_leave = leave_;
    std::array<FloatVec, kGroups> far_enter = enter_;
    LaneMask near_lanes = 0;
    LaneMask far_lanes = 0;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (skip(lanes_, g)) continue;
      const FloatVec inverse = load(axis.inverse, g);
      const FloatVec near_until = hn::Mul(hn::Sub(split, load(axis.near_origin, g)), inverse);
      const FloatVec far_from = hn::Mul(hn::Sub(split, load(axis.far_origin, g)), inverse);
      near_leave[g] = min_unless_nan(near_until, leave_[g]);
      far_enter[g] = max_unless_nan(far_from, enter_[g]);
      near_lanes |= bits_of(hn::Le(enter_[g], near_leave[g])) << (g * kGroupLanes);
      far_lanes |= bits_of(hn::Le(far_enter[g], leave_[g])) << (g * kGroupLanes);
    }
    if (near_lanes != 0) {
      if (far_lanes != 0) {
        Postponed& entry = stack_[depth_++];
        entry.node = far;
        entry.lanes = far_lanes;
        for (std::size_t g = 0; g < kGroups; ++g) {
          if (skip(far_lanes, g)) continue;
          entry.enter[g] = far_enter[g];
          entry.leave[g] = leave_[g];
        }
      }
      leave_ = near_leave;
      node_ = near;
      lanes_ = near_lanes;
    } else {
      enter_ = far_enter;
      node_ = far;
      lanes_ = far_lanes;
    }
  }

  HWY_INLINE void pop() {
    lanes_ = 0;
    while (depth_ > 0) {
      const Postponed& next = stack_[--depth_];
      for (std::size_t g = 0; g < kGroups; ++g) {
        if (skip(next.lanes, g)) continue;
        enter_[g] = next.enter[g];
        leave_[g] = hn::Min(next.leave[g], load(rays_.limit, g));
        lanes_ |= bits_of(hn::Le(enter_[g], leave_[g])) << (g * kGroupLanes);
      }
      if (lanes_ != 0) {
        node_ = next.node;
        return;
      }
    }
  }

  /// A lane left alone goes on in scalars, which are faster for one ray.
  template <class Recorder>
  HWY_INLINE void walk_alone(Recorder& recorder) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes_));
    alignas(64) Lanes<float> enter;
    alignas(64) Lanes<float> leave;
    for (std::size_t g = 0; g < kGroups; ++g) {
      store(enter_[g], enter, g);
      store(leave_[g], leave, g);
    }
    walk_lane(tree_, triangles_, rays_, lane, node_, enter[lane], leave[lane], recorder);
    pop();
  }

  /// Returns how many triangles were tested.
  template <class Recorder>
  HWY_INLINE std::uint32_t test_leaf(const KdNode node, Recorder& recorder) {
    const std::uint32_t count = node.count();
    const std::uint32_t* const list = leaf_triangles_ + node.first();
    LaneMask lanes = lanes_;
    for (std::uint32_t i = 0; i < count; ++i) {
      recorder.triangle(lanes);
      const std::uint32_t triangle = list[i];
      const float* const corners = &triangles_[triangle].a.x;
      for (std::size_t g = 0; g < kGroups; ++g) {
        if (skip(lanes, g)) continue;
        const LaneMask ended = test_triangle(corners, triangle, g, group_bits(lanes, g), rays_);
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
  PassRays& rays_;
  std::uint32_t node_ = 0;
  LaneMask lanes_ = 0;
  std::array<FloatVec, kGroups> enter_;
  std::array<FloatVec, kGroups> leave_;
  std::size_t depth_ = 0;
  std::array<Postponed, kMaxKdDepth> stack_;
};

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
