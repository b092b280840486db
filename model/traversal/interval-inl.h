// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Included once for every instruction set; see hwy/foreach_target.h.
#if defined(SHEAF_TRAVERSAL_INTERVAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEAF_TRAVERSAL_INTERVAL_INL_H_
#undef SHEAF_TRAVERSAL_INTERVAL_INL_H_
#else
#define SHEAF_TRAVERSAL_INTERVAL_INL_H_
#endif

#include <array>
#include <bit>

#include "traversal/interval_bounds.h"
#include "traversal/leaf_tester-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

/// The walk of rays of one direction-sign configuration with one decision for all: MLRTA, after
/// Reshetov, Soupikov and Hurley 2005, sections 3 and 4. A node is visited if the interval
/// arithmetic of IntervalBounds cannot rule out that some ray meets it. A leaf with triangles is
/// tested with the rays that meet its box, clipped as MaskedCursor would have clipped them on the
/// way down, so that the tests are the very same.
template <std::size_t kGroups>
class IntervalCursor {
 public:
  /// `sign` is the direction-sign configuration of the rays in `members`, bit a for axis a.
  IntervalCursor(const KdTree& tree, const TriangleRecord* triangles, PackedRays& rays,
                 LaneMask members, unsigned sign)
      : tree_(tree),
        rays_(rays),
        sign_(sign),
        lanes_(entering(members, rays)),
        bounds_(rays, lanes_),
        leaves_(tree, triangles, rays, members) {}

  template <class Recorder>
  void walk(Recorder& recorder) {
    if (lanes_ != 0) walk_from(root(), recorder);
  }

  /// The same from the deepest node under which all leaves with triangles lie that the pass might
  /// meet. MLRTA looks for it among the nodes where the pass divides; a leaf found in the far part
  /// of the highest such node ends the search, for nothing deeper can then hold them all.
  template <class Recorder>
  void walk_from_entry(Recorder& recorder) {
    if (lanes_ == 0) return;
    std::array<Fork, kMaxKdDepth> forks;
    std::size_t num_forks = 0;
    State entry = root();
    while (!descend_to_leaf(entry, forks, num_forks, recorder)) {
      if (num_forks == 0) return;  // nothing but empty leaves
      entry = forks[--num_forks].far;
    }
    for (std::size_t i = 0; i < num_forks; ++i) {
      if (has_triangles(forks[i].far, recorder)) {
        entry = forks[i].node;
        break;
      }
    }
    walk_from(entry, recorder);
  }

 private:
  /// Where the walk stands: a node, its box and the interval in which a ray might be in it.
  struct State {
    Box box;
    float enter, leave;
    std::uint32_t node;
  };
  /// A node both of whose children are visited.
  struct Fork {
    State node, far;
  };

  static LaneMask entering(LaneMask members, const PackedRays& rays) {
    LaneMask lanes = 0;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (skip<kGroups>(members, g)) continue;
      lanes |= bits_of(hn::Le(load(rays.enter, g), load(rays.leave, g))) << (g * kGroupLanes);
    }
    return lanes & members;
  }

  State root() const { return {tree_.bounds, bounds_.enter, bounds_.leave, 0}; }

  template <class Recorder>
  void walk_from(State now, Recorder& recorder) {
    std::array<State, kMaxKdDepth> stack;
    std::size_t size = 0;
    float limit = std::numeric_limits<float>::infinity();
    for (;;) {
      const KdNode node = tree_.nodes[now.node];
      if (!node.is_leaf()) {
        recorder.inner(now.node, lanes_);
        if (step(node, now, stack[size])) ++size;
        continue;
      }
      recorder.leaf(0);
      if (node.count() == 0) {
        recorder.leaf_done(now.node, 0);
      } else {
        recorder.leaf_clipped(now.node, test_leaf(node, now.box, recorder));
        limit = greatest_limit();
      }
      do {
        if (size == 0) return;
        now = stack[--size];
        now.leave = std::min(now.leave, limit);
      } while (now.enter > now.leave);
    }
  }

  /// From an inner node to a child that is visited, the near one if there is a choice. Returns
  /// whether there is, and then the far one too.
  bool step(const KdNode node, State& now, State& far) const {
    const auto axis = node.axis();
    const auto a = static_cast<std::size_t>(axis);
    const bool negative = ((sign_ >> a) & 1U) != 0;
    const float near_leave = std::min(bounds_.near_until(a, node.split()), now.leave);
    const float far_enter = std::max(bounds_.far_from(a, node.split()), now.enter);
    far = now;
    far.node = negative ? now.node + 1 : node.right_child();
    far.enter = far_enter;
    (negative ? far.box.hi : far.box.lo)[axis] = node.split();
    if (now.enter > near_leave) {
      now = far;
      return false;
    }
    now.node = negative ? node.right_child() : now.node + 1;
    now.leave = near_leave;
    (negative ? now.box.lo : now.box.hi)[axis] = node.split();
    return far_enter <= far.leave;
  }

  template <class Recorder>
  std::uint32_t test_leaf(const KdNode node, const Box& box, Recorder& recorder) {
    const LaneMask lanes = clip(box);
    return lanes == 0 ? 0 : leaves_.test(node, lanes, recorder);
  }

  /// The lanes that meet a box before their limit.
  LaneMask clip(const Box& box) const {
    LaneMask lanes = 0;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (skip<kGroups>(lanes_, g)) continue;
      FloatVec enter = load(rays_.enter, g);
      FloatVec leave = hn::Min(load(rays_.leave, g), load(rays_.limit, g));
      for (std::size_t a = 0; a < 3; ++a) {
        const bool negative = ((sign_ >> a) & 1U) != 0;
        const auto axis = static_cast<int>(a);
        const FloatVec first = hn::Set(FloatTag(), (negative ? box.hi : box.lo)[axis]);
        const FloatVec last = hn::Set(FloatTag(), (negative ? box.lo : box.hi)[axis]);
        const PackedRays::Axis& rays = rays_.axis[a];
        const FloatVec inverse = load(rays.inverse, g);
        enter = max_unless_nan(hn::Mul(hn::Sub(first, load(rays.far_origin, g)), inverse), enter);
        leave = min_unless_nan(hn::Mul(hn::Sub(last, load(rays.near_origin, g)), inverse), leave);
      }
      lanes |= bits_of(hn::Le(enter, leave)) << (g * kGroupLanes);
    }
    return lanes & lanes_;
  }

  /// Beyond which no ray needs another hit.
  float greatest_limit() const {
    float greatest = -std::numeric_limits<float>::infinity();
    for (LaneMask left = lanes_; left != 0; left &= left - 1) {
      greatest = std::max(greatest, rays_.limit[static_cast<std::size_t>(std::countr_zero(left))]);
    }
    return greatest;
  }

  /// Down the near children to a leaf, noting where the pass divides; returns whether it has
  /// triangles.
  template <class Recorder>
  bool descend_to_leaf(State& now, std::array<Fork, kMaxKdDepth>& forks, std::size_t& num_forks,
                       Recorder& recorder) const {
    for (;;) {
      const KdNode node = tree_.nodes[now.node];
      if (node.is_leaf()) {
        recorder.search_leaf(now.node);
        return node.count() != 0;
      }
      recorder.search_inner(now.node, lanes_);
      forks[num_forks].node = now;
      if (step(node, now, forks[num_forks].far)) ++num_forks;
    }
  }

  /// Whether a leaf with triangles might be met below a node.
  template <class Recorder>
  bool has_triangles(State now, Recorder& recorder) const {
    std::array<Fork, kMaxKdDepth> forks;
    std::size_t num_forks = 0;
    while (!descend_to_leaf(now, forks, num_forks, recorder)) {
      if (num_forks == 0) return false;
      now = forks[--num_forks].far;
    }
    return true;
  }

  const KdTree& tree_;
  PackedRays& rays_;
  const unsigned sign_;
  const LaneMask lanes_;  ///< that meet the tree's bounds
  const IntervalBounds bounds_;
  const LeafTester<kGroups> leaves_;
};

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
