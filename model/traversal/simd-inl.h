// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Included once for every instruction set; see hwy/foreach_target.h.
#if defined(SHEAF_TRAVERSAL_SIMD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEAF_TRAVERSAL_SIMD_INL_H_
#undef SHEAF_TRAVERSAL_SIMD_INL_H_
#else
#define SHEAF_TRAVERSAL_SIMD_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>
#include <type_traits>

#include "traversal/ray_packet.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = HWY_CAPPED(float, 16);
using IndexTag = hn::RebindToUnsigned<FloatTag>;
using FloatVec = hn::Vec<FloatTag>;
using FloatMask = hn::Mask<FloatTag>;

/// Lanes of one vector, a "group".
inline constexpr std::size_t kGroupLanes = hn::MaxLanes(FloatTag());
static_assert(kMaxPacketSize % kGroupLanes == 0);
inline constexpr LaneMask kGroupMask = (LaneMask{1} << kGroupLanes) - 1;

HWY_INLINE FloatVec load(const Lanes<float>& lanes, std::size_t group) {
  return hn::Load(FloatTag(), lanes.data() + group * kGroupLanes);
}
HWY_INLINE void store(FloatVec value, Lanes<float>& lanes, std::size_t group) {
  hn::Store(value, FloatTag(), lanes.data() + group * kGroupLanes);
}

/// A mask as bits: bit i is lane i.
HWY_INLINE LaneMask bits_of(FloatMask mask) {
  std::conditional_t<(kGroupLanes > 8), std::uint16_t, std::uint8_t> bits = 0;
  std::uint8_t bytes[8];
  hn::StoreMaskBits(FloatTag(), mask, bytes);
  hwy::CopyBytes<sizeof(bits)>(bytes, &bits);
  return bits;
}
HWY_INLINE FloatMask mask_of(LaneMask bits) {
  std::uint8_t bytes[8];
  hwy::CopyBytes<8>(&bits, bytes);
  return hn::LoadMaskBits(FloatTag(), bytes);
}
HWY_INLINE LaneMask group_bits(LaneMask lanes, std::size_t group) {
  return (lanes >> (group * kGroupLanes)) & kGroupMask;
}

/// Whether a group of `kGroups` has none of the lanes; a group alone always has one.
template <std::size_t kGroups>
HWY_INLINE bool skip(LaneMask lanes, std::size_t group) {
  return kGroups > 1 && group_bits(lanes, group) == 0;
}

/// The lesser or greater of two numbers; `b` where `a` is NaN. `b` is never NaN.
HWY_INLINE FloatVec min_unless_nan(FloatVec a, FloatVec b) {
  return hn::Min(a, b);
}
HWY_INLINE FloatVec max_unless_nan(FloatVec a, FloatVec b) {
  return hn::Max(a, b);
}

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
