// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "kdtree/kd_tree.h"
#include "scene/scene.h"
#include "stats/counters.h"
#include "traversal/ray_packet.h"

namespace sheaf {

/// One step of a packet through the tree: it visited `node`; if the node is a leaf with triangles,
/// the packet's rays were tested against its first `num_tests` triangles (fewer than the leaf
/// holds only if every lane ended early with any_hit).
struct TraceStep {
  std::uint32_t node = 0;
  std::uint32_t num_tests = 0;
};

/// What a packet touched on its way, in order; the timed units replay it. Reused between packets,
/// so that it allocates only until it has grown to the longest walk.
using TraceLog = std::vector<TraceStep>;

/// Counts of the coherence measures. "Packet" counts one for a whole packet (each masked pass
/// counted), "lane" counts active lanes; under masked traversal the lane counts equal the sums over
/// the rays traced one by one.
#define SHEAF_TRACE_COUNTERS(X)                                                        \
  X(packet_inner_visits, "nodes", "Inner nodes visited by packets, each pass counted") \
  X(packet_leaf_visits, "nodes", "Leaves visited by packets, each pass counted")       \
  X(packet_triangle_tests, "tests", "Triangles tested by packets")                     \
  X(lane_inner_visits, "nodes", "Inner nodes visited, summed over active lanes")       \
  X(lane_leaf_visits, "nodes", "Leaves visited, summed over active lanes")             \
  X(lane_triangle_tests, "tests", "Triangles tested, summed over active lanes")        \
  X(passes, "passes", "Direction-sign configurations traversed")
SHEAF_STATS(TraceCounts, SHEAF_TRACE_COUNTERS);

enum class TraversalScheme : std::uint8_t { kSingle, kMasked };

/// Per-lane counts of one packet, for heat maps and per-ray measures.
struct LaneCounts {
  Lanes<std::uint32_t> inner_visits;
  Lanes<std::uint32_t> triangle_tests;
};

/// Triangle corners in the order in which the intersection unit fetches them: one record a
/// primitive, built once per scene.
struct TriangleRecord {
  Vec3 a, b, c;
};

/// Traces the active lanes of a packet through the tree and fills its hit_* lanes.
///
/// kMasked walks all lanes of one direction-sign configuration together, one pass per configuration
/// present (in ascending order of its 3-bit code, bit axis = sign bit of the direction). kSingle
/// walks lane after lane. Both give identical hits, and identical lane counts. A hit at equal t
/// goes to the lower primitive number. Hits lie in 0 <= t <= t_max (any_hit lanes: t < t_max).
/// `log` and `lanes` may be null: what is not asked for is not recorded.
void trace_packet(TraversalScheme scheme, const KdTree& tree,
                  const std::vector<TriangleRecord>& triangles, RayPacket& packet, TraceLog* log,
                  LaneCounts* lanes, TraceCounts& counts);

}  // namespace sheaf
