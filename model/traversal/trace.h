// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kdtree/kd_tree.h"
#include "scene/scene.h"
#include "stats/counters.h"
#include "traversal/ray_packet.h"

namespace sheaf {

/// One step of a packet through the tree: it visited `node`; if the node is a leaf with triangles,
/// the packet's rays were tested against its first `num_tests` triangles (fewer than the leaf
/// holds only if every lane ended early with any_hit, or none met the leaf's box).
struct TraceStep {
  std::uint32_t node = 0;
  std::uint32_t num_tests : 31 = 0;
  std::uint32_t clips : 1 = 0;  ///< interval: the rays were clipped to the leaf's box before
};

/// What a packet touched on its way, in order; the timed units replay it. Reused between packets,
/// so that it allocates only until it has grown to the longest walk.
using TraceLog = std::vector<TraceStep>;

/// Counts of the coherence measures. "Packet" counts one for a whole packet (each pass counted),
/// "lane" what the rays would do if each were traced alone. Under masked traversal that is the sum
/// of active lanes; for interval and omni, whose packets take rays to places where they would not
/// go alone, the rays are walked once more to count it.
#define SHEAF_TRACE_COUNTERS(X)                                                                \
  X(packet_inner_visits, "nodes", "Inner nodes visited by packets, each pass counted")         \
  X(packet_leaf_visits, "nodes", "Leaves visited by packets, each pass counted")               \
  X(packet_triangle_tests, "tests", "Triangles tested by packets")                             \
  X(lane_inner_visits, "nodes", "Inner nodes visited by rays, each alone")                     \
  X(lane_leaf_visits, "nodes", "Leaves visited by rays, each alone")                           \
  X(lane_triangle_tests, "tests", "Triangles tested by rays, each alone")                      \
  X(passes, "passes", "Walks of packets through the tree, one a direction-sign configuration") \
  X(search_visits, "nodes", "Inner nodes that packets visited looking for an entry point")     \
  X(leaf_clips, "clips", "Times a packet's rays were clipped to a leaf's box")
SHEAF_STATS(TraceCounts, SHEAF_TRACE_COUNTERS);

enum class TraversalScheme : std::uint8_t { kSingle, kMasked, kInterval, kIntervalEntry, kOmni };
inline constexpr std::array kTraversalSchemes{
    TraversalScheme::kSingle, TraversalScheme::kMasked, TraversalScheme::kInterval,
    TraversalScheme::kIntervalEntry, TraversalScheme::kOmni};

/// Per-lane counts of one packet, for heat maps and per-ray measures: what the lane took part in.
/// Under interval, where one decision serves a whole pass, these are all nodes of its pass.
struct LaneCounts {
  Lanes<std::uint32_t> inner_visits;
  Lanes<std::uint32_t> triangle_tests;
};

/// Triangle corners in the order in which the intersection unit fetches them: one record a
/// primitive, built once per scene.
struct TriangleRecord {
  Vec3 a, b, c;
};

/// Issue slots that a step takes, where a packet's lanes take `packet_slots`: an interval step
/// computes for the whole pass what others compute for each ray, once; clipping to a box computes
/// the distances to six planes for each ray, where a step computes those to two.
[[nodiscard]] constexpr std::uint32_t step_slots(TraversalScheme scheme, const TraceStep& step,
                                                 std::uint32_t packet_slots) {
  const bool one_for_all =
      scheme == TraversalScheme::kInterval || scheme == TraversalScheme::kIntervalEntry;
  if (!one_for_all) return packet_slots;
  return step.clips != 0 ? 3 * packet_slots : 1;
}

/// Traces the active lanes of a packet through the tree and fills its hit_* lanes.
///
/// kSingle walks lane after lane. kMasked walks all lanes of one direction-sign configuration
/// together, one pass per configuration present (in ascending order of its 3-bit code, bit axis =
/// sign bit of the direction). kOmni (Reshetov 2006) walks all lanes in one pass whatever their
/// signs. kInterval (Reshetov, Soupikov and Hurley, "Multi-level ray tracing algorithm", 2005, in
/// passes like kMasked) takes one decision for a whole pass, by interval arithmetic on its rays'
/// origins and directions, and clips the rays to the box of a leaf before it tests them;
/// kIntervalEntry first looks for the deepest node that the pass can be begun at.
///
/// All give identical hits: a hit at equal t goes to the lower primitive number. kSingle and
/// kMasked give identical lane counts, the interval schemes never lower ones. Hits lie in
/// 0 <= t <= t_max (any_hit lanes: t < t_max).
/// `log` and `lanes` may be null: what is not asked for is not recorded.
void trace_packet(TraversalScheme scheme, const KdTree& tree,
                  const std::vector<TriangleRecord>& triangles, RayPacket& packet, TraceLog* log,
                  LaneCounts* lanes, TraceCounts& counts);

}  // namespace sheaf
