// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Random machines on random scenes: each finishes, conserves, and makes the picture and the rays of
// the untimed pipeline.
#include <gtest/gtest.h>

#include <algorithm>

#include "generators.h"
#include "stability/covering_array.h"
#include "stability/machine_run.h"

namespace sheaf::stability {
namespace {

void expect_like_untimed(const MachineScene& scene) {
  const MachineRun untimed = scene.run({"run.fidelity=functional"});
  const MachineRun run = scene.run(any_machine());
  RC_ASSERT(run.error.empty());
  RC_ASSERT(run.picture == untimed.picture);
  RC_ASSERT(run.rays == untimed.rays);
}

RC_GTEST_PROP(MachinesProperty, PictureAndRaysAreThoseOfTheUntimedPipeline, ()) {
  static const MachineScene scene(1);
  expect_like_untimed(scene);
}

RC_GTEST_PROP(MachinesProperty, OnAnySceneTheSame, ()) {
  const Scene scene = any_scene();
  const auto level = static_cast<std::uint32_t>(*rc::gen::inRange(0, 4));
  expect_like_untimed(MachineScene(scene, level));
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
