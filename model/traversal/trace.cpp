// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "traversal/trace.h"

// The kernels keep vectors in arrays, which vectors of unknown size cannot; and SSSE3 alone is not
// worth its compile time.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/trace.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "traversal/interval-inl.h"
#include "traversal/masked-inl.h"
#include "traversal/ray_setup-inl.h"
#include "traversal/recorder.h"
#include "traversal/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sheaf::HWY_NAMESPACE {

/// Bit i is set if lane i of `values` has its sign bit set.
HWY_INLINE LaneMask sign_bits(const Lanes<float>& values, int size) {
  LaneMask bits = 0;
  const FloatTag d;
  for (std::size_t g = 0; g * kGroupLanes < static_cast<std::size_t>(size); ++g) {
    const FloatVec one = hn::CopySign(hn::Set(d, 1.0F), load(values, g));
    bits |= bits_of(hn::Lt(one, hn::Zero(d))) << (g * kGroupLanes);
  }
  return bits;
}

/// Puts the results back into the packet's lanes.
HWY_INLINE void unpack(const PackedRays& rays, RayPacket& packet) {
  for (std::size_t from = 0; from < static_cast<std::size_t>(rays.count); ++from) {
    const std::size_t to = rays.packet_lane[from];
    const bool hit = ((rays.has_hit >> from) & 1U) != 0;
    packet.hit_t[to] = hit ? rays.hit_t[from] : packet.t_max[to];
    packet.hit_u[to] = hit ? rays.hit_u[from] : 0.0F;
    packet.hit_v[to] = hit ? rays.hit_v[from] : 0.0F;
    packet.hit_triangle[to] = hit ? rays.hit_triangle[from] : kNoHit;
  }
}

template <class Recorder>
HWY_INLINE void walk_single(const KdTree& tree, const TriangleRecord* triangles, PackedRays& rays,
                            Recorder& recorder) {
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(rays.count); ++lane) {
    if (!(rays.enter[lane] <= rays.leave[lane])) continue;
    walk_lane(tree, triangles, rays, lane, 0, rays.enter[lane], rays.leave[lane], recorder);
  }
}

/// Rays of one direction-sign configuration.
struct Pass {
  LaneMask members;
  unsigned sign;
};

/// Packs the rays so that those of a configuration lie side by side; returns the number of passes.
HWY_INLINE std::size_t pack_by_sign(const RayPacket& packet, Packer& packer,
                                    std::array<Pass, 8>& passes) {
  const LaneMask signs[3] = {sign_bits(packet.direction[0], packet.size),
                             sign_bits(packet.direction[1], packet.size),
                             sign_bits(packet.direction[2], packet.size)};
  std::size_t count = 0;
  for (unsigned sign = 0; sign < 8; ++sign) {
    LaneMask members = packet.active;
    for (std::size_t a = 0; a < 3; ++a) {
      members &= ((sign >> a) & 1U) != 0 ? signs[a] : ~signs[a];
    }
    if (members != 0) passes[count++] = {packer.put(members), sign};
  }
  return count;
}

/// All rays as one pass, whatever their signs.
HWY_INLINE std::size_t pack_all(const RayPacket& packet, Packer& packer,
                                std::array<Pass, 8>& passes) {
  passes[0] = {packer.put(packet.active), 0};
  return 1;
}

// Apart from masked traversal, whose speed matters most, so that they do not weigh on its frame.
template <std::size_t kGroups, class Recorder>
HWY_NOINLINE void walk_omni(const KdTree& tree, const TriangleRecord* triangles, PackedRays& rays,
                            const Pass& pass, Recorder& recorder) {
  MaskedCursor<kGroups, true>(tree, triangles, rays, pass.members, pass.sign).walk(recorder);
}
// One number of vectors for all: the walk is in scalars, and leaves skip vectors without a ray.
template <class Recorder>
HWY_NOINLINE void walk_interval(const KdTree& tree, const TriangleRecord* triangles,
                                PackedRays& rays, const Pass& pass, bool from_entry,
                                Recorder& recorder) {
  constexpr std::size_t kMostGroups = kMaxPacketSize / kGroupLanes;
  IntervalCursor<kMostGroups> cursor(tree, triangles, rays, pass.members, pass.sign);
  if (from_entry) {
    cursor.walk_from_entry(recorder);
  } else {
    cursor.walk(recorder);
  }
}

/// One pass, in `kGroups` vectors.
template <std::size_t kGroups, class Recorder>
HWY_INLINE void walk_pass_in(TraversalScheme scheme, const KdTree& tree,
                             const TriangleRecord* triangles, PackedRays& rays, const Pass& pass,
                             Recorder& recorder) {
  if (scheme == TraversalScheme::kMasked) {
    MaskedCursor<kGroups, false>(tree, triangles, rays, pass.members, pass.sign).walk(recorder);
  } else if (scheme == TraversalScheme::kOmni) {
    walk_omni<kGroups>(tree, triangles, rays, pass, recorder);
  } else {
    const bool from_entry = scheme == TraversalScheme::kIntervalEntry;
    walk_interval(tree, triangles, rays, pass, from_entry, recorder);
  }
}

/// Walks with the fewest vectors that hold the rays, of the numbers of vectors compiled.
template <std::size_t kGroups, class Recorder>
HWY_INLINE void walk_pass(TraversalScheme scheme, const KdTree& tree,
                          const TriangleRecord* triangles, PackedRays& rays, const Pass& pass,
                          Recorder& recorder) {
  if constexpr (kGroups * kGroupLanes < kMaxPacketSize) {
    if (static_cast<std::size_t>(rays.count) > kGroups * kGroupLanes) {
      constexpr std::size_t kMore = kGroupLanes * kGroups == 4 ? 4 : 2;
      walk_pass<kMore * kGroups>(scheme, tree, triangles, rays, pass, recorder);
      return;
    }
  }
  walk_pass_in<kGroups>(scheme, tree, triangles, rays, pass, recorder);
}

/// Walks a packet and leaves what it found in `rays`.
template <bool kRecord>
HWY_INLINE TraceCounts walk_packet(TraversalScheme scheme, const KdTree& tree,
                                   const TriangleRecord* triangles, const RayPacket& packet,
                                   PackedRays& rays, TraceLog* log, LaneCounts* lanes) {
  RawRays raw;
  std::array<Pass, 8> passes;
  std::size_t num_passes = 0;
  Packer packer(packet, raw, rays);
  if (scheme == TraversalScheme::kSingle || scheme == TraversalScheme::kOmni) {
    num_passes = pack_all(packet, packer, passes);
  } else {
    num_passes = pack_by_sign(packet, packer, passes);
  }
  packer.pad();
  set_up_rays(raw, tree.bounds, rays);

  Recorder<kRecord> recorder(log, lanes, rays);
  TraceCounts counts;
  if (scheme == TraversalScheme::kSingle) {
    walk_single(tree, triangles, rays, recorder);
    counts.passes = static_cast<std::uint64_t>(rays.count);
  } else {
    constexpr std::size_t kLeastGroups = kGroupLanes == 1 ? kMaxPacketSize : 1;
    for (std::size_t i = 0; i < num_passes; ++i) {
      walk_pass<kLeastGroups>(scheme, tree, triangles, rays, passes[i], recorder);
    }
    counts.passes = num_passes;
  }
  counts += recorder.counts();
  return counts;
}

/// Replaces what the lanes took part in by what each would do alone.
HWY_NOINLINE void count_alone(const KdTree& tree, const TriangleRecord* triangles,
                              const RayPacket& packet, TraceCounts& counts) {
  PackedRays rays;
  const TraceCounts alone =
      walk_packet<false>(TraversalScheme::kMasked, tree, triangles, packet, rays, nullptr, nullptr);
  counts.lane_inner_visits = alone.lane_inner_visits;
  counts.lane_leaf_visits = alone.lane_leaf_visits;
  counts.lane_triangle_tests = alone.lane_triangle_tests;
}

template <bool kRecord>
void trace(TraversalScheme scheme, const KdTree& tree, const TriangleRecord* triangles,
           RayPacket& packet, TraceLog* log, LaneCounts* lanes, TraceCounts& counts) {
  PackedRays rays;
  TraceCounts found = walk_packet<kRecord>(scheme, tree, triangles, packet, rays, log, lanes);
  if (scheme != TraversalScheme::kSingle && scheme != TraversalScheme::kMasked) {
    count_alone(tree, triangles, packet, found);
  }
  unpack(rays, packet);
  counts += found;
}

void trace_counted(TraversalScheme scheme, const KdTree& tree, const TriangleRecord* triangles,
                   RayPacket& packet, TraceLog* log, LaneCounts* lanes, TraceCounts& counts) {
  trace<false>(scheme, tree, triangles, packet, log, lanes, counts);
}
void trace_recorded(TraversalScheme scheme, const KdTree& tree, const TriangleRecord* triangles,
                    RayPacket& packet, TraceLog* log, LaneCounts* lanes, TraceCounts& counts) {
  trace<true>(scheme, tree, triangles, packet, log, lanes, counts);
}

}  // namespace sheaf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sheaf {

HWY_EXPORT(trace_counted);
HWY_EXPORT(trace_recorded);

void trace_packet(TraversalScheme scheme, const KdTree& tree,
                  const std::vector<TriangleRecord>& triangles, RayPacket& packet, TraceLog* log,
                  LaneCounts* lanes, TraceCounts& counts) {
  if (log != nullptr) log->clear();
  if (lanes != nullptr) *lanes = {};
  if (packet.active == 0) return;
  const TriangleRecord* const records = triangles.data();
  if (log == nullptr && lanes == nullptr) {
    HWY_DYNAMIC_DISPATCH(trace_counted)(scheme, tree, records, packet, log, lanes, counts);
  } else {
    HWY_DYNAMIC_DISPATCH(trace_recorded)(scheme, tree, records, packet, log, lanes, counts);
  }
}

}  // namespace sheaf
#endif  // HWY_ONCE
