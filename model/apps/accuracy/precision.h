// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "config/config.h"
#include "system/prepared_scene.h"

namespace sheaf {

/// What it costs to keep split planes, rays or both in fewer bits (traversal/reduced_precision.h).
struct PrecisionCost {
  std::string stored;  ///< in the format: planes, rays, both, or nothing
  std::string format;
  int node_bits = 0;            ///< saved, of the 64 of an inner node
  int ray_bits = 0;             ///< saved, of the 192 of a ray's origin and inverse direction
  double steps = 0;             ///< added, per step in full precision
  double tests = 0;             ///< triangle tests added, likewise
  std::uint64_t differing = 0;  ///< rays that hit something else than in the machine
  double rmse = 0;              ///< of the picture that these hits give, against the machine's
};

struct PrecisionCosts {
  std::uint64_t num_rays = 0;    ///< of the frame
  std::uint64_t num_traced = 0;  ///< of these with fewer bits: every one in so many packets
  std::vector<PrecisionCost> rows;
};

/// About how many rays are walked anew at most.
inline constexpr std::uint64_t kMostPrecisionRays = 200'000;

/// Renders the frame without time, once in full precision and once for every format and what is
/// stored in it, each time with the hits of the walk in fewer bits in place of the machine's. Of a
/// large frame only every n-th packet is walked anew. No rows if `stop` ended it.
[[nodiscard]] PrecisionCosts precision_costs(const Config& config, const PreparedScene& scene,
                                             const std::function<bool()>& stop);

// For people, and one row a format and what is stored in it.
[[nodiscard]] std::string precision_text(const PrecisionCosts& costs);
[[nodiscard]] std::string precision_csv(const PrecisionCosts& costs);

}  // namespace sheaf
