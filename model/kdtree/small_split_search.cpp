// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/small_node.h"

// Vectors of unknown size cannot be kept in structs.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kdtree/small_split_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = HWY_CAPPED(float, SmallNode::kCapacity);
using IntTag = hn::RebindToSigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
constexpr FloatTag kFloats;
constexpr IntTag kInts;

// Candidates are numbered axis · 4 C + triangle · 4 + face · 2 + (planar triangles left), where C
// is kCapacity and face is 1 for the upper one. Every lane sees its candidates in ascending order.
constexpr std::size_t kAxisStride = 4 * SmallNode::kCapacity;

HWY_INLINE Floats broadcast(double value) {
  return hn::Set(kFloats, static_cast<float>(value));
}

// The cheapest candidate so far in every lane.
struct Best {
  Floats cost;
  Ints candidate;

  HWY_INLINE void offer(Floats offered, Ints number) {
    const auto better = hn::Lt(offered, cost);
    cost = hn::IfThenElse(better, offered, cost);
    candidate = hn::IfThenElse(hn::RebindMask(kInts, better), number, candidate);
  }
};

// What the cost of a plane across one axis of a cell depends on; positions are measured in extents
// of the cell.
struct AxisCost {
  Floats lo, hi, per_extent, cap, side, traversal, bonus;

  HWY_INLINE AxisCost(const Box& cell, int axis, const SahCosts& costs) {
    const Vec3d extent = Vec3d(cell.hi) - Vec3d(cell.lo);
    const double du = extent[(axis + 1) % 3];
    const double dv = extent[(axis + 2) % 3];
    const double scale = costs.intersection / half_area(cell);
    lo = hn::Set(kFloats, cell.lo[axis]);
    hi = hn::Set(kFloats, cell.hi[axis]);
    per_extent = broadcast(1.0 / extent[axis]);
    cap = broadcast(scale * du * dv);
    side = broadcast(scale * (du + dv) * extent[axis]);
    traversal = broadcast(costs.traversal);
    bonus = broadcast(costs.empty_bonus);
  }

  [[nodiscard]] HWY_INLINE Floats at(Floats x, Ints left_count, Ints right_count) const {
    const Floats num_left = hn::ConvertTo(kFloats, left_count);
    const Floats num_right = hn::ConvertTo(kFloats, right_count);
    const Floats share = hn::Mul(hn::Sub(x, lo), per_extent);
    const Floats left = hn::Add(cap, hn::Mul(side, share));
    const Floats right = hn::Add(cap, hn::Mul(side, hn::Sub(hn::Set(kFloats, 1.0F), share)));
    const Floats sum =
        hn::Add(traversal, hn::Add(hn::Mul(left, num_left), hn::Mul(right, num_right)));
    const auto empty = hn::Eq(hn::Min(num_left, num_right), hn::Zero(kFloats));
    const auto inside = hn::And(hn::Gt(x, lo), hn::Lt(x, hi));
    const Floats favoured = hn::IfThenElse(empty, hn::Mul(sum, bonus), sum);
    return hn::IfThenElse(inside, favoured, broadcast(std::numeric_limits<float>::infinity()));
  }
};

// Adds 1 where the mask is set.
template <class Mask>
HWY_INLINE Ints count_if(Ints count, Mask mask) {
  return hn::Sub(count, hn::BitCast(kInts, hn::VecFromMask(kFloats, mask)));
}

// How many triangles lie below and above each of a vector of planes, and how many in it.
struct Counts {
  Ints below, above, planar;

  HWY_INLINE void add(Floats lo, Floats hi, Floats x) {
    below = count_if(below, hn::Lt(lo, x));
    above = count_if(above, hn::Gt(hi, x));
  }
  HWY_INLINE void add_planar(Floats lo, Floats hi, Floats x) {
    planar = count_if(planar, hn::And(hn::Eq(lo, x), hn::Eq(hi, x)));
  }
};

template <bool kPlanar>
HWY_INLINE void offer(const AxisCost& cost, Floats x, const Counts& counts, Ints number,
                      Best& best) {
  if constexpr (kPlanar) {
    best.offer(cost.at(x, counts.below, hn::Add(counts.above, counts.planar)), number);
    best.offer(cost.at(x, hn::Add(counts.below, counts.planar), counts.above),
               hn::Add(number, hn::Set(kInts, 1)));
  } else {
    best.offer(cost.at(x, counts.below, counts.above), number);
  }
}

// Offers the planes at all faces across axis k.
template <bool kPlanar>
HWY_INLINE void try_axis(const SmallNode& node, std::size_t k, const AxisCost& cost, Best& best) {
  for (std::size_t c = 0; c < node.count; c += hn::Lanes(kFloats)) {
    const Floats lower = hn::Load(kFloats, node.lo[k].data() + c);
    const Floats upper = hn::Load(kFloats, node.hi[k].data() + c);
    const Ints zero = hn::Zero(kInts);
    Counts at_lower{zero, zero, zero};
    Counts at_upper{zero, zero, zero};
    for (std::size_t i = 0; i < node.count; ++i) {
      const Floats lo = hn::Set(kFloats, node.lo[k][i]);
      const Floats hi = hn::Set(kFloats, node.hi[k][i]);
      at_lower.add(lo, hi, lower);
      at_upper.add(lo, hi, upper);
      if constexpr (kPlanar) {
        at_lower.add_planar(lo, hi, lower);
        at_upper.add_planar(lo, hi, upper);
      }
    }
    const Ints number = hn::Add(hn::ShiftLeft<2>(hn::Iota(kInts, static_cast<std::int32_t>(c))),
                                hn::Set(kInts, static_cast<std::int32_t>(k * kAxisStride)));
    offer<kPlanar>(cost, lower, at_lower, number, best);
    offer<kPlanar>(cost, upper, at_upper, hn::Add(number, hn::Set(kInts, 2)), best);
  }
}

bool has_planar(const SmallNode& node, std::size_t k) {
  auto any = hn::Lt(hn::Zero(kFloats), hn::Zero(kFloats));
  for (std::size_t c = 0; c < node.count; c += hn::Lanes(kFloats)) {
    any = hn::Or(any, hn::Eq(hn::Load(kFloats, node.lo[k].data() + c),
                             hn::Load(kFloats, node.hi[k].data() + c)));
  }
  return !hn::AllFalse(kFloats, any);
}

// The cheapest of all lanes; of equal ones the first, however many lanes there are.
std::int32_t first_cheapest(const Best& best) {
  alignas(64) SmallNode::Row cost;
  alignas(64) std::array<std::int32_t, SmallNode::kCapacity> candidate{};
  hn::Store(best.cost, kFloats, cost.data());
  hn::Store(best.candidate, kInts, candidate.data());
  std::size_t found = 0;
  for (std::size_t lane = 1; lane < hn::Lanes(kFloats); ++lane) {
    // Only lanes that found something are below the leaf's cost; the others are equal to it.
    const bool first = cost[lane] == cost[found] && candidate[lane] < candidate[found];
    if (cost[lane] < cost[found] || first) found = lane;
  }
  return candidate[found];
}

}  // namespace

std::int32_t find_candidate(const SmallNode& node, const Box& cell, const SahCosts& costs) {
  const double leaf_cost = costs.intersection * static_cast<double>(node.count);
  Best best{broadcast(leaf_cost), hn::Set(kInts, -1)};
  for (std::size_t k = 0; k < 3; ++k) {
    const AxisCost cost(cell, static_cast<int>(k), costs);
    if (has_planar(node, k)) {
      try_axis<true>(node, k, cost, best);
    } else {
      try_axis<false>(node, k, cost, best);
    }
  }
  return first_cheapest(best);
}

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sheaf {

HWY_EXPORT(find_candidate);

SplitPlane find_split(const SmallNode& node, const Box& cell, const SahCosts& costs) {
  // No split costs less than K_T and the bonus.
  const double leaf_cost = costs.intersection * static_cast<double>(node.count);
  if (leaf_cost <= costs.empty_bonus * costs.traversal || !(half_area(cell) > 0.0)) return {};
  const std::int32_t candidate = HWY_DYNAMIC_DISPATCH(find_candidate)(node, cell, costs);
  if (candidate < 0) return {};
  const auto number = static_cast<std::size_t>(candidate);
  constexpr std::size_t kAxisStride = 4 * SmallNode::kCapacity;
  const std::size_t axis = number / kAxisStride;
  const std::size_t triangle = number % kAxisStride / 4;
  const bool upper = number % 4 >= 2;
  return {static_cast<int>(axis), (upper ? node.hi : node.lo)[axis][triangle], number % 2 == 1};
}

}  // namespace sheaf
#endif  // HWY_ONCE
