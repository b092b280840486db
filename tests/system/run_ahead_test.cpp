// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/simulate.h"

namespace sheaf::test {
namespace {

/// Every statistic but the number of wake-ups, which tells of the simulator's own work.
nlohmann::json machine_statistics(const Outcome& outcome) {
  nlohmann::json stats = outcome.stats;
  stats.erase("system.num_wakes");
  return stats;
}

class RunningAhead : public testing::TestWithParam<Settings> {};

TEST_P(RunningAhead, ChangesNoCycleAndNoCounter) {
  const TestScene scene(committed_scene("dragon"),
                        {"image.width=48", "image.height=32", "render.recursion_level=3"});
  const Outcome ahead = scene.run(GetParam());
  const Outcome in_step = scene.run_in_step(GetParam());
  ASSERT_EQ(ahead.error, "");
  ASSERT_EQ(in_step.error, "");
  EXPECT_LT(ahead.count("system.num_wakes"), in_step.count("system.num_wakes"));
  EXPECT_EQ(machine_statistics(ahead), machine_statistics(in_step));
}

INSTANTIATE_TEST_SUITE_P(
    Machines, RunningAhead,
    testing::Values(Settings{}, Settings{"ray_cache.heuristic=none", "flow.control=credits"},
                    Settings{"link.depth=1", "link.latency=1", "link.memory_latency=1"},
                    Settings{"traversal_unit.count=5", "intersection_unit.count=3",
                             "shader_unit.count=2", "link.depth=2"},
                    Settings{"intersection_unit.contexts=1", "intersection_unit.latency=50",
                             "traversal_unit.contexts=16", "link.depth=1"},
                    Settings{"shader_unit.initiation_interval=100", "link.depth=1"},
                    Settings{"link.memory_latency=1"}, Settings{"link.latency=1"},
                    Settings{"node_cache.mshrs=1", "triangle_cache.mshrs=1", "l2.mshrs=1"},
                    Settings{"dram.model=DDR4-2400"},
                    Settings{"dram.model=HBM2-2000", "l2.capacity=64KiB", "film_cache.line=16"},
                    Settings{"flow.control=spill", "flow.spill_queue=20", "dram.model=DDR4-2400"},
                    Settings{"crossbar.request_width=16", "crossbar.response_width=16",
                             "crossbar.depth=1", "film_cache.write_policy=through",
                             "film_cache.write_buffer=2", "l2.write_buffer=2",
                             "l2.write_allocate=true", "l2.mshr_targets=1", "l2.ports=2",
                             "triangle_cache.sectors=4", "triangle_cache.banks=2",
                             "node_cache.replacement=random", "node_cache.mshr_targets=1"},
                    Settings{"shader_cache.cells=4", "shader_unit.count=2"},
                    Settings{"shader_cache.cells=2", "ray_cache.heuristic=none", "link.depth=1",
                             "link.latency=1", "flow.control=credits"},
                    Settings{"ray_cache.heuristic=grid(4)", "ray_cache.order=breadth_first",
                             "traversal.scheme=omni"},
                    Settings{"l2.mode=absent", "dram.latency=1000", "flow.control=credits"}));

}  // namespace
}  // namespace sheaf::test
