// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Random machines: each finishes, conserves, and makes the picture and the rays of the untimed
// pipeline. RapidCheck prints the seed of a failure and shrinks it towards small numbers.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "stability/covering_array.h"
#include "stability/machine_run.h"

namespace sheaf::stability {
namespace {

RC_GTEST_PROP(MachinesProperty, PictureAndRaysAreThoseOfTheUntimedPipeline, ()) {
  static const MachineScene scene(1);
  static const MachineRun untimed = scene.run({"run.fidelity=functional"});
  std::vector<std::string> settings;
  const auto add = [&](const char* key, int lowest, int highest) {
    settings.push_back(fmt::format("{}={}", key, *rc::gen::inRange(lowest, highest + 1)));
  };
  for (const char* unit : {"traversal_unit", "intersection_unit", "shader_unit"}) {
    add(fmt::format("{}.count", unit).c_str(), 1, 8);
    add(fmt::format("{}.contexts", unit).c_str(), 1, 64);
    add(fmt::format("{}.latency", unit).c_str(), 1, 1000);
  }
  add("ray_cache.cells", 1, 100);
  add("ray_cache.timeout", 0, 1000);
  add("packet_fifo.depth", 1, 100);
  add("packet.size", 1, 64);
  add("flow.tile_size", 8, 64);
  add("link.latency", 1, 100);
  add("link.depth", 1, 100);
  settings.push_back(std::string("ray_cache.heuristic=") +
                     *rc::gen::element("none", "dir", "mdir(24)", "fastpos", "pos(1)", "opos"));
  const MachineRun run = scene.run(settings);
  RC_ASSERT(run.error.empty());
  RC_ASSERT(run.picture == untimed.picture);
  RC_ASSERT(run.rays == untimed.rays);
}

/// Whether each pair of levels of any two factors stands in some row.
bool covers_pairs(const std::vector<std::vector<std::size_t>>& rows,
                  const std::vector<std::size_t>& levels) {
  for (std::size_t a = 0; a < levels.size(); ++a) {
    for (std::size_t b = a + 1; b < levels.size(); ++b) {
      std::vector<bool> seen(levels[a] * levels[b]);
      for (const auto& row : rows) seen[row[a] * levels[b] + row[b]] = true;
      if (std::find(seen.begin(), seen.end(), false) != seen.end()) return false;
    }
  }
  return true;
}

TEST(CoveringArray, HoldsEveryPairOfLevelsInFewRows) {
  const std::vector<std::size_t> levels = {6, 5, 3, 3, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2};
  const auto rows = covering_array(levels, 2);
  EXPECT_TRUE(covers_pairs(rows, levels));
  EXPECT_GE(rows.size(), 30U);  // of the two largest alone
  EXPECT_LE(rows.size(), 60U);
  EXPECT_EQ(rows, covering_array(levels, 2));
  EXPECT_FALSE(covers_pairs({rows.begin(), rows.begin() + 25}, levels));
}

}  // namespace
}  // namespace sheaf::stability
