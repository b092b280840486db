// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Included once for every instruction set; see hwy/foreach_target.h.
#if defined(SHEAF_TRAVERSAL_PACKET_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEAF_TRAVERSAL_PACKET_TRIANGLE_INL_H_
#undef SHEAF_TRAVERSAL_PACKET_TRIANGLE_INL_H_
#else
#define SHEAF_TRAVERSAL_PACKET_TRIANGLE_INL_H_
#endif

#include <limits>

#include "traversal/packed_rays.h"
#include "traversal/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

/// ShearedTriangle, one triangle as the rays of a group see it.
struct ShearedGroup {
  FloatVec ax, ay, az;
  FloatVec bx, by, bz;
  FloatVec cx, cy, cz;
};

/// A triangle's nine coordinates in the order of each ray's own x, y and z.
struct PermutedCorners {
  FloatVec a[3], b[3], c[3];
};

/// The axis that all rays of a pass share as their z, or kNoSharedAxis.
using SharedAxis = std::size_t;
inline constexpr SharedAxis kNoSharedAxis = 3;

HWY_INLINE SharedAxis shared_axis(LaneMask lanes, const PackedRays& rays) {
  SharedAxis axis = 0;
  while (axis < 3 && (lanes & ~rays.longest[axis]) != 0) ++axis;
  return axis;
}

HWY_INLINE PermutedCorners permute_all(const float* corners, SharedAxis z) {
  const FloatTag d;
  const std::size_t x = z == 2 ? 0 : z + 1;
  const std::size_t axes[3] = {x, x == 2 ? 0 : x + 1, z};
  PermutedCorners p;
  for (std::size_t k = 0; k < 3; ++k) {
    p.a[k] = hn::Set(d, corners[axes[k]]);
    p.b[k] = hn::Set(d, corners[3 + axes[k]]);
    p.c[k] = hn::Set(d, corners[6 + axes[k]]);
  }
  return p;
}

/// Each lane picks its own axis out of four floats that every 128-bit block holds a copy of. Four
/// floats from the last corner on would end behind the record, so that they start one before it.
HWY_INLINE PermutedCorners permute_each(const float* corners, std::size_t group,
                                        const PackedRays& rays) {
  const FloatTag d;
  PermutedCorners p;
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t k = 0; k < 3; ++k) {
    const float* const from = corners + rays.permutation[k][group];
    p.a[k] = hn::Set(d, from[0]);
    p.b[k] = hn::Set(d, from[3]);
    p.c[k] = hn::Set(d, from[6]);
  }
#else
  const IndexTag di;
  const auto a = hn::BitCast(di, hn::LoadDup128(d, corners));
  const auto b = hn::BitCast(di, hn::LoadDup128(d, corners + 3));
  const auto c = hn::BitCast(di, hn::LoadDup128(d, corners + 5));
  for (std::size_t k = 0; k < 3; ++k) {
    // Byte i of lane's float `axis` is byte 4 axis + i.
    const auto axis = hn::Load(di, rays.permutation[k].data() + group * kGroupLanes);
    const auto bytes = hn::Add(hn::Mul(axis, hn::Set(di, 0x04040404U)), hn::Set(di, 0x03020100U));
    p.a[k] = hn::BitCast(d, hn::TableLookupBytes(a, bytes));
    p.b[k] = hn::BitCast(d, hn::TableLookupBytes(b, bytes));
    p.c[k] = hn::BitCast(d, hn::TableLookupBytes(c, hn::Add(bytes, hn::Set(di, 0x04040404U))));
  }
#endif
  return p;
}

HWY_INLINE ShearedGroup shear_group(const float* corners, SharedAxis shared, std::size_t group,
                                    const PackedRays& rays) {
  const PermutedCorners p =
      shared != kNoSharedAxis ? permute_all(corners, shared) : permute_each(corners, group, rays);
  const FloatVec origin_x = load(rays.origin[0], group);
  const FloatVec origin_y = load(rays.origin[1], group);
  const FloatVec origin_z = load(rays.origin[2], group);
  const FloatVec shear_x = load(rays.shear[0], group);
  const FloatVec shear_y = load(rays.shear[1], group);
  const FloatVec shear_z = load(rays.shear[2], group);
  const auto shear = [&](const FloatVec(&corner)[3], FloatVec& x, FloatVec& y, FloatVec& z) {
    const FloatVec along = hn::Sub(corner[2], origin_z);
    x = hn::Sub(hn::Sub(corner[0], origin_x), hn::Mul(shear_x, along));
    y = hn::Sub(hn::Sub(corner[1], origin_y), hn::Mul(shear_y, along));
    z = hn::Mul(shear_z, along);
  };
  ShearedGroup s;
  shear(p.a, s.ax, s.ay, s.az);
  shear(p.b, s.bx, s.by, s.bz);
  shear(p.c, s.cx, s.cy, s.cz);
  return s;
}

struct HitGroup {
  FloatVec t, u, v;
};

/// Decides in doubles for the given lanes; returns those that hit.
HWY_NOINLINE LaneMask decide_in_double(const ShearedGroup& s, LaneMask lanes, HitGroup& hit) {
  const FloatTag d;
  const FloatVec vectors[9] = {s.ax, s.ay, s.az, s.bx, s.by, s.bz, s.cx, s.cy, s.cz};
  alignas(64) float values[9][kGroupLanes];
  for (std::size_t i = 0; i < 9; ++i) hn::Store(vectors[i], d, values[i]);
  alignas(64) float t[kGroupLanes];
  alignas(64) float u[kGroupLanes];
  alignas(64) float v[kGroupLanes];
  hn::Store(hit.t, d, t);
  hn::Store(hit.u, d, u);
  hn::Store(hit.v, d, v);
  LaneMask hits = 0;
  for (LaneMask left = lanes; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    const ShearedTriangle one{values[0][i], values[1][i], values[2][i], values[3][i], values[4][i],
                              values[5][i], values[6][i], values[7][i], values[8][i]};
    TriangleHit found{0.0F, 0.0F, 0.0F};
    if (!hit_in_double(one, found)) continue;
    hits |= LaneMask{1} << i;
    t[i] = found.t;
    u[i] = found.u;
    v[i] = found.v;
  }
  hit = {hn::Load(d, t), hn::Load(d, u), hn::Load(d, v)};
  return hits;
}

/// Stores the hits of the lanes where they win; returns the lanes that end with them.
HWY_INLINE LaneMask accept(const HitGroup& hit, std::uint32_t triangle, std::size_t group,
                           LaneMask lanes, PackedRays& rays) {
  const FloatTag d;
  const IndexTag di;
  std::uint32_t* const triangles = rays.hit_triangle.data() + group * kGroupLanes;
  const FloatVec limit = load(rays.limit, group);
  const auto number = hn::Set(di, triangle);
  const FloatMask lower = hn::RebindMask(d, hn::Lt(number, hn::Load(di, triangles)));
  const FloatMask wins = hn::Or(hn::Lt(hit.t, limit), hn::And(hn::Eq(hit.t, limit), lower));
  lanes &= bits_of(hn::And(wins, hn::Ge(hit.t, hn::Zero(d))));
  if (lanes == 0) return 0;
  const FloatMask mask = mask_of(lanes);
  const LaneMask ended = lanes & group_bits(rays.any_hit, group);
  rays.has_hit |= lanes << (group * kGroupLanes);
  hn::BlendedStore(hit.t, mask, d, rays.hit_t.data() + group * kGroupLanes);
  hn::BlendedStore(hit.u, mask, d, rays.hit_u.data() + group * kGroupLanes);
  hn::BlendedStore(hit.v, mask, d, rays.hit_v.data() + group * kGroupLanes);
  hn::BlendedStore(number, hn::RebindMask(di, mask), di, triangles);
  const FloatVec nothing = hn::Set(d, -std::numeric_limits<float>::infinity());
  hn::BlendedStore(hn::IfThenElse(mask_of(ended), nothing, hit.t), mask, d,
                   rays.limit.data() + group * kGroupLanes);
  return ended;
}

/// hit_sheared() and what follows from it for the given lanes of a group; returns the lanes that
/// end with this triangle.
HWY_INLINE LaneMask test_triangle(const float* corners, std::uint32_t triangle, SharedAxis shared,
                                  std::size_t group, LaneMask lanes, PackedRays& rays) {
  const FloatTag d;
  const FloatVec zero = hn::Zero(d);
  const ShearedGroup s = shear_group(corners, shared, group, rays);
  const FloatVec u = hn::Sub(hn::Mul(s.cx, s.by), hn::Mul(s.cy, s.bx));
  const FloatVec v = hn::Sub(hn::Mul(s.ax, s.cy), hn::Mul(s.ay, s.cx));
  const FloatVec w = hn::Sub(hn::Mul(s.bx, s.ay), hn::Mul(s.by, s.ax));
  const FloatVec least = hn::Min(hn::Min(u, v), w);
  const FloatVec most = hn::Max(hn::Max(u, v), w);
  lanes &= bits_of(hn::Or(hn::Ge(least, zero), hn::Le(most, zero)));
  if (HWY_LIKELY(lanes == 0)) return 0;

  const FloatVec area = hn::Add(hn::Add(u, v), w);
  const FloatVec depth = hn::Add(hn::Add(hn::Mul(u, s.az), hn::Mul(v, s.bz)), hn::Mul(w, s.cz));
  HitGroup hit{hn::Div(depth, area), hn::Div(v, area), hn::Div(w, area)};
  const FloatMask zeros = hn::Or(hn::Or(hn::Eq(u, zero), hn::Eq(v, zero)), hn::Eq(w, zero));
  const LaneMask unsure = lanes & bits_of(zeros);
  if (HWY_UNLIKELY(unsure != 0)) {
    lanes = (lanes & ~unsure) | decide_in_double(s, unsure, hit);
  }
  return accept(hit, triangle, group, lanes, rays);
}

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
