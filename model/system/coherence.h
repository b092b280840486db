// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "stats/counters.h"
#include "stats/report_tree.h"
#include "system/build_plan.h"
#include "system/prepared_scene.h"

namespace sheaf {

#define SHEAF_COHERENCE_COUNTERS(X)                                                         \
  X(s_t, "nodes", "Inner nodes visited, summed over rays, each traced alone")               \
  X(s_u, "nodes", "Distinct inner nodes visited by any ray of a scope, summed over scopes") \
  X(i_t, "tests", "Triangle tests, summed over rays, each traced alone")                    \
  X(i_u, "triangles", "Distinct triangles tested by any ray of a scope, summed over scopes")
SHEAF_STATS(CoherenceCounts, SHEAF_COHERENCE_COUNTERS);

/// c_t = s_t / s_u and c_i = i_t / i_u of a scene, which depend on the rays and the tree but not on
/// how rays are gathered: one untimed pass over all rays of the frame, each traced alone, scope by
/// scope (a tile of primary pixels, or the frame).
class CoherencePass {
 public:
  CoherencePass(Config config, const PreparedScene& scene);

  /// `stop` is asked at every packet of primary rays; once it says so, the pass ends there. Returns
  /// whether it is complete.
  bool run(const std::function<bool()>& stop);
  void report(bool has_secondary, StatsTree& stats) const;

  [[nodiscard]] const CoherenceCounts& primary() const { return primary_.counts; }
  [[nodiscard]] const CoherenceCounts& secondary() const { return secondary_.counts; }

 private:
  /// Distinct nodes and triangles of the current scope: those whose stamp is the scope's number.
  struct Scope {
    CoherenceCounts counts;
    std::vector<std::uint32_t> node_stamps;
    std::vector<std::uint32_t> triangle_stamps;
    std::uint32_t number = 0;
  };
  void trace(RayPacket& packet, Scope& scope);

  const Config config_;
  const PreparedScene& scene_;
  TraceLog log_;
  Scope primary_;
  Scope secondary_;
};

}  // namespace sheaf
