// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Included once for every instruction set; see hwy/foreach_target.h.
#if defined(SHEAF_TRAVERSAL_LEAF_TESTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEAF_TRAVERSAL_LEAF_TESTER_INL_H_
#undef SHEAF_TRAVERSAL_LEAF_TESTER_INL_H_
#else
#define SHEAF_TRAVERSAL_LEAF_TESTER_INL_H_
#endif

#include "kdtree/kd_tree.h"
#include "traversal/packet_triangle-inl.h"
#include "traversal/trace.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

/// Tests rays in `kGroups` vectors against the triangles of leaves.
template <std::size_t kGroups>
class LeafTester {
 public:
  /// `members`: the lanes that will ever be tested.
  LeafTester(const KdTree& tree, const TriangleRecord* triangles, PackedRays& rays,
             LaneMask members)
      : leaf_triangles_(tree.leaf_triangles.data()),
        triangles_(triangles),
        rays_(rays),
        shared_axis_(shared_axis(members, rays)) {}

  /// Returns how many triangles were tested: all, unless every lane ended before.
  template <class Recorder>
  HWY_INLINE std::uint32_t test(const KdNode node, LaneMask lanes, Recorder& recorder) const {
    const std::uint32_t count = node.count();
    const std::uint32_t* const list = leaf_triangles_ + node.first();
    for (std::uint32_t i = 0; i < count; ++i) {
      recorder.triangle(lanes);
      const std::uint32_t triangle = list[i];
      const float* const corners = &triangles_[triangle].a.x;
      for (std::size_t g = 0; g < kGroups; ++g) {
        if (skip<kGroups>(lanes, g)) continue;
        const LaneMask ended =
            test_triangle(corners, triangle, shared_axis_, g, group_bits(lanes, g), rays_);
        lanes &= ~(ended << (g * kGroupLanes));
      }
      if (lanes == 0) return i + 1;
    }
    return count;
  }

 private:
  const std::uint32_t* const leaf_triangles_;
  const TriangleRecord* const triangles_;
  PackedRays& rays_;
  const SharedAxis shared_axis_;
};

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
