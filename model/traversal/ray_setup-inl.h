// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Included once for every instruction set; see hwy/foreach_target.h.
#if defined(SHEAF_TRAVERSAL_RAY_SETUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEAF_TRAVERSAL_RAY_SETUP_INL_H_
#undef SHEAF_TRAVERSAL_RAY_SETUP_INL_H_
#else
#define SHEAF_TRAVERSAL_RAY_SETUP_INL_H_
#endif

#include <limits>

#include "geometry/box.h"
#include "traversal/packed_rays.h"
#include "traversal/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

/// Origins, directions and t_max of the rays before anything is computed from them.
struct alignas(64) RawRays {
  std::array<Lanes<float>, 3> origin;
  std::array<Lanes<float>, 3> direction;
  Lanes<float> t_max;
};

/// Moves lanes of a packet into the lanes of a PackedRays, one behind the other.
class Packer {
 public:
  Packer(const RayPacket& packet, RawRays& raw, PackedRays& rays)
      : packet_(packet), raw_(raw), rays_(rays) {
    rays_.count = 0;
    rays_.any_hit = 0;
    rays_.has_hit = 0;
  }

  /// Returns the lanes that the given lanes of the packet went to.
  HWY_INLINE LaneMask put(LaneMask lanes) {
    const int begin = rays_.count;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto from = static_cast<std::size_t>(std::countr_zero(lanes));
      const auto to = static_cast<std::size_t>(rays_.count++);
      rays_.any_hit |= ((packet_.any_hit >> from) & 1U) << to;
      rays_.packet_lane[to] = static_cast<std::uint8_t>(from);
      copy(from, to);
      raw_.t_max[to] = packet_.t_max[from];
    }
    const auto up_to = [](int lane) {
      return lane == 64 ? ~LaneMask{0} : (LaneMask{1} << lane) - 1;
    };
    return up_to(rays_.count) & ~up_to(begin);
  }

  /// Fills up the last vector with copies of a ray that may meet nothing.
  HWY_INLINE void pad() {
    for (auto to = static_cast<std::size_t>(rays_.count); to % kGroupLanes != 0; ++to) {
      copy(rays_.packet_lane[0], to);
      raw_.t_max[to] = -1.0F;
    }
  }

 private:
  HWY_INLINE void copy(std::size_t from, std::size_t to) {
    for (std::size_t a = 0; a < 3; ++a) {
      raw_.origin[a][to] = packet_.origin[a][from];
      raw_.direction[a][to] = packet_.direction[a][from];
    }
  }

  const RayPacket& packet_;
  RawRays& raw_;
  PackedRays& rays_;
};

/// `choice` 0, 1 or 2 as two masks: picks the component of that axis.
struct AxisChoice {
  FloatMask is_x, is_y;
  HWY_INLINE FloatVec pick(FloatVec x, FloatVec y, FloatVec z) const {
    return hn::IfThenElse(is_x, x, hn::IfThenElse(is_y, y, z));
  }
};

/// The part of the watertight test, for one group; see ShearedRay, which computes the same.
HWY_INLINE AxisChoice set_up_shear(const RawRays& raw, std::size_t group, PackedRays& rays) {
  const FloatTag d;
  const FloatVec dir[3] = {load(raw.direction[0], group), load(raw.direction[1], group),
                           load(raw.direction[2], group)};
  const FloatVec length[3] = {hn::Abs(dir[0]), hn::Abs(dir[1]), hn::Abs(dir[2])};
  AxisChoice longest;
  longest.is_x = hn::And(hn::Ge(length[0], length[1]), hn::Ge(length[0], length[2]));
  longest.is_y = hn::AndNot(longest.is_x, hn::Ge(length[1], length[2]));

  const FloatVec org[3] = {load(raw.origin[0], group), load(raw.origin[1], group),
                           load(raw.origin[2], group)};
  const FloatVec dir_z = longest.pick(dir[0], dir[1], dir[2]);
  store(longest.pick(org[1], org[2], org[0]), rays.origin[0], group);
  store(longest.pick(org[2], org[0], org[1]), rays.origin[1], group);
  store(longest.pick(org[0], org[1], org[2]), rays.origin[2], group);
  store(hn::Div(longest.pick(dir[1], dir[2], dir[0]), dir_z), rays.shear[0], group);
  store(hn::Div(longest.pick(dir[2], dir[0], dir[1]), dir_z), rays.shear[1], group);
  store(hn::Div(hn::Set(d, 1.0F), dir_z), rays.shear[2], group);

  const IndexTag di;
  const auto axis = [&](std::uint32_t if_x, std::uint32_t if_y, std::uint32_t if_z) {
    const auto as_float = [&](std::uint32_t i) { return hn::BitCast(d, hn::Set(di, i)); };
    return hn::BitCast(di, longest.pick(as_float(if_x), as_float(if_y), as_float(if_z)));
  };
  const std::size_t at = group * kGroupLanes;
  hn::Store(axis(1, 2, 0), di, rays.permutation[0].data() + at);
  hn::Store(axis(2, 0, 1), di, rays.permutation[1].data() + at);
  hn::Store(axis(0, 1, 2), di, rays.permutation[2].data() + at);
  return longest;
}

/// Prepares the crossing of planes and of the tree's bounds, for one group.
///
/// The watertight test sees a triangle whose corners, relative to the ray, are off by rounding:
/// with u = 2^-24 and M_k the greatest distance from the origin to the bounds along axis k, at most
/// u (2 M_k + 4 M_z) along the ray's x and y (the idea, and 5u, are from Woop, Benthin and Wald
/// 2013, section 4.2; 2 and 4 count the roundings of `(a_k - o_k) - s (a_z - o_z)` and of s).
/// A plane's distance (split - o) · (1/d) has three roundings of its own, as much as a shift of the
/// plane by 3.01u M_k. Moving the origin by 6u (M_k + M_z) covers both, and 2u |o_k| the rounding
/// of the moved origin itself. With the origin moved back, planes come out too far: a ray stays
/// in the near child at least until then. Moved on, they come out too near: the far child begins
/// there. Both are right for planes behind the ray too, for the signs are exact.
HWY_INLINE void set_up_planes(const RawRays& raw, std::size_t group, const Box& bounds,
                              const AxisChoice& longest, PackedRays& rays) {
  const FloatTag d;
  constexpr float kHalfUlp = 0x1p-24F;
  FloatVec reach[3];
  for (std::size_t a = 0; a < 3; ++a) {
    const FloatVec org = load(raw.origin[a], group);
    const auto axis = static_cast<int>(a);
    reach[a] = hn::Max(hn::Abs(hn::Sub(hn::Set(d, bounds.lo[axis]), org)),
                       hn::Abs(hn::Sub(hn::Set(d, bounds.hi[axis]), org)));
  }
  const FloatVec reach_z = longest.pick(reach[0], reach[1], reach[2]);

  FloatVec enter = hn::Zero(d);
  FloatVec leave = load(raw.t_max, group);
  FloatVec sum = hn::Zero(d);
  for (std::size_t a = 0; a < 3; ++a) {
    const FloatVec org = load(raw.origin[a], group);
    const FloatVec dir = load(raw.direction[a], group);
    const FloatVec error = hn::Add(hn::Mul(hn::Set(d, 6.0F * kHalfUlp), hn::Add(reach[a], reach_z)),
                                   hn::Mul(hn::Set(d, 2.0F * kHalfUlp), hn::Abs(org)));
    const FloatVec shift = hn::CopySignToAbs(error, dir);
    const FloatVec near_origin = hn::Sub(org, shift);
    const FloatVec far_origin = hn::Add(org, shift);
    const FloatVec inverse = hn::Div(hn::Set(d, 1.0F), dir);
    store(near_origin, rays.axis[a].near_origin, group);
    store(far_origin, rays.axis[a].far_origin, group);
    store(inverse, rays.axis[a].inverse, group);

    const auto axis = static_cast<int>(a);
    const FloatVec lo = hn::Set(d, bounds.lo[axis]);
    const FloatVec hi = hn::Set(d, bounds.hi[axis]);
    const FloatMask negative = hn::Lt(hn::CopySign(hn::Set(d, 1.0F), dir), hn::Zero(d));
    const FloatVec first = hn::IfThenElse(negative, hi, lo);
    const FloatVec last = hn::IfThenElse(negative, lo, hi);
    enter = max_unless_nan(hn::Mul(hn::Sub(first, far_origin), inverse), enter);
    leave = min_unless_nan(hn::Mul(hn::Sub(last, near_origin), inverse), leave);
    sum = hn::Add(sum, hn::Add(org, dir));
  }
  // A ray that is not finite, or that would enter at infinity, meets nothing.
  const FloatVec zero_if_finite = hn::Sub(hn::Add(sum, enter), hn::Add(sum, enter));
  const FloatMask finite = hn::Eq(zero_if_finite, hn::Zero(d));
  store(enter, rays.enter, group);
  store(hn::IfThenElse(finite, leave, hn::Set(d, -1.0F)), rays.leave, group);
}

/// A closest-hit lane accepts t <= t_max, an any-hit lane t < t_max: with t_max as the limit, the
/// tie rule says so if the one starts with the highest and the other with the lowest primitive.
HWY_INLINE void set_up_results(const RawRays& raw, std::size_t group, PackedRays& rays) {
  const FloatTag d;
  const IndexTag di;
  const FloatVec largest = hn::Set(d, std::numeric_limits<float>::max());
  store(hn::Min(load(raw.t_max, group), largest), rays.limit, group);
  const FloatMask any_hit = mask_of(group_bits(rays.any_hit, group));
  const auto none = hn::BitCast(d, hn::Set(di, kNoHit));
  hn::Store(hn::BitCast(di, hn::IfThenZeroElse(any_hit, none)), di,
            rays.hit_triangle.data() + group * kGroupLanes);
}

/// Computes all that the kernels need of the rays packed.
HWY_INLINE void set_up_rays(const RawRays& raw, const Box& bounds, PackedRays& rays) {
  rays.longest = {};
  const auto count = static_cast<std::size_t>(rays.count);
  for (std::size_t group = 0; group * kGroupLanes < count; ++group) {
    const AxisChoice longest = set_up_shear(raw, group, rays);
    const LaneMask is_x = bits_of(longest.is_x);
    const LaneMask is_y = bits_of(longest.is_y);
    const std::size_t first = group * kGroupLanes;
    rays.longest[0] |= is_x << first;
    rays.longest[1] |= is_y << first;
    rays.longest[2] |= (~(is_x | is_y) & kGroupMask) << first;
    set_up_planes(raw, group, bounds, longest, rays);
    set_up_results(raw, group, rays);
  }
}

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
