// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/simulate.h"

namespace sheaf::test {
namespace {

Settings decoupled(Settings machine, const std::string& quantum) {
  machine.emplace_back("run.fidelity=decoupled");
  machine.push_back("run.quantum=" + quantum);
  return machine;
}

struct Decoupled : testing::TestWithParam<Settings> {
  const TestScene scene{
      committed_scene("dragon"),
      {"image.width=48", "image.height=32", "render.recursion_level=3", "film.format=exact"}};
};

TEST_P(Decoupled, WithoutAQuantumIsTimed) {
  const Outcome timed = scene.run(GetParam());
  const Outcome exact = scene.run(decoupled(GetParam(), "0"));
  ASSERT_EQ(timed.error, "");
  ASSERT_EQ(exact.error, "");
  EXPECT_EQ(exact.stats, timed.stats);
}

// A run checks itself that nothing is lost and that every account adds up.
TEST_P(Decoupled, LosesNothingHoweverFarUnitsRunAhead) {
  const Outcome timed = scene.run(GetParam());
  for (const char* quantum : {"1", "16", "1000", "1000000"}) {
    const Outcome outcome = scene.run(decoupled(GetParam(), quantum));
    ASSERT_EQ(outcome.error, "") << quantum;
    EXPECT_TRUE(outcome.complete) << quantum;
    EXPECT_TRUE(outcome.image == timed.image) << quantum;
    EXPECT_EQ(outcome.entries({"rays."}), timed.entries({"rays."})) << quantum;
  }
}

TEST_P(Decoupled, GivesTheSameTwice) {
  const Settings machine = decoupled(GetParam(), "100");
  EXPECT_EQ(scene.run(machine).stats, scene.run(machine).stats);
}

INSTANTIATE_TEST_SUITE_P(
    Machines, Decoupled,
    testing::Values(Settings{}, Settings{"ray_cache.heuristic=none", "flow.control=credits"},
                    Settings{"link.depth=1", "link.latency=1", "link.memory_latency=1"},
                    Settings{"traversal_unit.count=5", "intersection_unit.count=3",
                             "shader_unit.count=2", "link.depth=2", "flow.control=credits"},
                    Settings{"flow.control=spill", "flow.spill_queue=32"},
                    Settings{"node_cache.mshrs=1", "triangle_cache.mshrs=1", "l2.mshrs=1"},
                    Settings{"dram.model=HBM2-2000", "l2.capacity=64KiB", "film_cache.line=16"},
                    Settings{"shader_cache.cells=2", "shader_unit.count=2", "link.depth=1",
                             "dram.model=DDR4-2400", "ray_cache.timeout=100"}));

TEST(DecoupledQuantum, WakesUnitsLessOften) {
  const TestScene scene(committed_scene("dragon"), {"image.width=48", "image.height=32"});
  EXPECT_LT(scene.run(decoupled({}, "16")).count("system.num_wakes"),
            scene.run(decoupled({}, "0")).count("system.num_wakes"));
}

}  // namespace
}  // namespace sheaf::test
