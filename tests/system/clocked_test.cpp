// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Timed machines are compared with the reference, in which every unit ticks in every cycle: every
// cycle, every counter, every pixel is the same.

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/scenes.h"
#include "support/simulate.h"

namespace sheaf::test {
namespace {

const Settings kSmall{"image.width=48", "image.height=32", "render.recursion_level=2"};

/// Every statistic but the number of wake-ups, which tells of the simulator's own work.
nlohmann::json machine_statistics(const Outcome& outcome) {
  nlohmann::json stats = outcome.stats;
  stats.erase("system.num_wakes");
  return stats;
}

void expect_equal(const TestScene& scene, const Settings& machine) {
  Settings ticking = machine;
  ticking.emplace_back("run.fidelity=clocked");
  const Outcome timed = scene.run(machine);
  const Outcome clocked = scene.run(ticking);
  ASSERT_EQ(timed.error, "");
  ASSERT_EQ(clocked.error, "");
  EXPECT_EQ(timed.complete, clocked.complete);
  EXPECT_EQ(machine_statistics(timed), machine_statistics(clocked));
  EXPECT_TRUE(timed.image == clocked.image);
}

class ClockedScenes : public testing::TestWithParam<const char*> {};

TEST_P(ClockedScenes, TimedEqualsClockedInEveryCounter) {
  const TestScene scene(committed_scene(GetParam()), kSmall);
  expect_equal(scene, {});
  expect_equal(scene, {"flow.control=credits", "ray_cache.heuristic=mdir(96)"});
  expect_equal(scene, {"ray_cache.heuristic=none", "dram.model=DDR4-2400"});
}

INSTANTIATE_TEST_SUITE_P(Committed, ClockedScenes, testing::ValuesIn(kCommittedScenes),
                         [](const auto& scene) { return std::string(scene.param); });

class ClockedMachines : public testing::TestWithParam<Settings> {};

TEST_P(ClockedMachines, TimedEqualsClockedInEveryCounter) {
  for (const char* name : {"dragon", "sponza"}) {
    const TestScene scene(committed_scene(name), kSmall);
    expect_equal(scene, GetParam());
  }
}

Settings all_caches(const std::string& setting) {
  Settings settings;
  for (const char* cache :
       {"node_cache", "triangle_cache", "attribute_cache", "texture_cache", "film_cache"}) {
    settings.push_back(std::string(cache) + '.' + setting);
  }
  return settings;
}

Settings operator+(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

INSTANTIATE_TEST_SUITE_P(
    Links, ClockedMachines,
    testing::Values(Settings{"link.depth=1", "link.latency=1", "link.memory_latency=1"},
                    Settings{"link.depth=1", "packet_fifo.depth=1", "flow.control=credits"},
                    Settings{"link.latency=1"}, Settings{"link.memory_latency=1"},
                    Settings{"link.latency=30", "link.depth=3", "link.memory_width=1"},
                    Settings{"link.latency=10", "link.depth=1", "traversal_unit.count=1",
                             "traversal_unit.contexts=4", "intersection_unit.count=1",
                             "intersection_unit.initiation_interval=10", "node_cache.mode=perfect",
                             "triangle_cache.mode=perfect"}));

INSTANTIATE_TEST_SUITE_P(
    Units, ClockedMachines,
    testing::Values(Settings{"traversal_unit.count=5", "intersection_unit.count=3",
                             "shader_unit.count=2", "link.depth=2"},
                    Settings{"traversal_unit.contexts=1", "intersection_unit.contexts=1",
                             "shader_unit.contexts=1"},
                    Settings{"intersection_unit.contexts=1", "intersection_unit.latency=50",
                             "traversal_unit.contexts=16", "link.depth=1"},
                    Settings{"shader_unit.initiation_interval=100", "link.depth=1"},
                    Settings{"packet.size=64", "traversal_unit.lanes=1",
                             "packet_arbiter.policy=secondary_first"},
                    Settings{"packet.size=1", "traversal.scheme=single",
                             "packet_arbiter.policy=primary_first"},
                    Settings{"traversal_unit.latency=1", "traversal_unit.initiation_interval=3",
                             "primary_source.interval=50"}));

INSTANTIATE_TEST_SUITE_P(
    Sorting, ClockedMachines,
    testing::Values(Settings{"ray_cache.heuristic=none", "flow.control=credits"},
                    Settings{"ray_cache.heuristic=pos(1)", "pos.relative=0.001"},
                    Settings{"ray_cache.heuristic=opos"},
                    Settings{"ray_cache.heuristic=mdir(24)", "ray_cache.cells=6",
                             "ray_cache.victim=lru", "ray_cache.group_by_kind=true"},
                    Settings{"ray_cache.heuristic=grid(4)", "ray_cache.order=breadth_first",
                             "traversal.scheme=omni"},
                    Settings{"ray_cache.timeout=200", "ray_cache.rays_per_cycle=1"},
                    Settings{"shader_cache.cells=4", "shader_unit.count=2"},
                    Settings{"shader_cache.cells=2", "ray_cache.heuristic=none", "link.depth=1",
                             "link.latency=1", "flow.control=credits"},
                    Settings{"shader_cache.cells=3", "shader_cache.rays_per_cycle=1",
                             "ray_cache.order=breadth_first", "traversal_unit.count=3"}));

INSTANTIATE_TEST_SUITE_P(
    Memory, ClockedMachines,
    testing::Values(all_caches("mode=perfect"), all_caches("mode=absent"),
                    all_caches("mode=absent") + Settings{"l2.mode=absent"},
                    all_caches("mshrs=1") + Settings{"l2.mshrs=1"},
                    all_caches("line=16") + all_caches("capacity=1KiB") +
                        Settings{"l2.line=128", "l2.capacity=16KiB", "l2.banks=1"},
                    Settings{"l2.mode=perfect", "l2.hit_latency=1"},
                    Settings{"l2.mode=absent", "dram.latency=1000", "flow.control=credits"},
                    Settings{"dram.latency=1", "dram.bytes_per_cycle=1"},
                    Settings{"film_cache.line=16", "film_cache.mshrs=1"}));

// Each option that a cache has, alone.
INSTANTIATE_TEST_SUITE_P(
    CacheOptions, ClockedMachines,
    testing::Values(all_caches("sectors=2") + Settings{"l2.sectors=2", "l2.capacity=16KiB"},
                    all_caches("banks=4"), all_caches("ports=2"), Settings{"l2.ports=2"},
                    all_caches("mshr_targets=1"), Settings{"l2.mshr_targets=1", "l2.mshrs=2"},
                    Settings{"film_cache.write_policy=through"},
                    Settings{"film_cache.write_allocate=false"},
                    Settings{"film_cache.write_buffer=1", "film_cache.line=16"},
                    Settings{"l2.write_policy=through", "l2.capacity=16KiB"},
                    Settings{"l2.write_allocate=true", "l2.capacity=16KiB", "film_cache.line=16"},
                    Settings{"l2.write_buffer=1", "l2.capacity=16KiB", "film_cache.line=16"},
                    Settings{"l2.write_buffer=1", "l2.mode=absent", "dram.model=DDR4-2400",
                             "film_cache.write_policy=through"}));

INSTANTIATE_TEST_SUITE_P(Crossbars, ClockedMachines,
                         testing::Values(Settings{"crossbar.request_width=4"},
                                         Settings{"crossbar.request_width=16", "crossbar.depth=1"},
                                         Settings{"crossbar.response_width=1"},
                                         Settings{"crossbar.response_width=1",
                                                  "film_cache.write_buffer=4", "l2.banks=1",
                                                  "l2.capacity=16KiB"}));

INSTANTIATE_TEST_SUITE_P(Spilling, ClockedMachines,
                         testing::Values(Settings{"flow.control=spill", "flow.spill_queue=64"},
                                         Settings{"flow.control=spill", "flow.spill_queue=16",
                                                  "link.depth=1", "ray_cache.heuristic=none"},
                                         Settings{"flow.control=spill", "flow.spill_queue=32",
                                                  "l2.line=128", "l2.sectors=2",
                                                  "film_cache.line=16", "shader_unit.count=3",
                                                  "l2.capacity=16KiB"}));

INSTANTIATE_TEST_SUITE_P(
    Dram, ClockedMachines,
    testing::Values(Settings{"dram.model=DDR4-2400"},
                    Settings{"dram.model=DDR4-3200", "l2.capacity=16KiB", "film_cache.line=16"},
                    Settings{"dram.model=HBM2-2000", "l2.capacity=64KiB", "film_cache.line=16"},
                    Settings{"dram.model=GDDR6-14000", "l2.mode=absent", "clock.frequency=1.7GHz"},
                    Settings{"dram.model=LPDDR5-6400", "l2.capacity=16KiB",
                             "flow.control=credits"}));

/// A machine with about half of these options, each with one of its values.
Settings random_machine(std::uint64_t seed) {
  struct Option {
    const char* key;
    std::vector<const char*> values;
  };
  const std::vector<Option> options{{"flow.control", {"credits", "spill"}},
                                    {"ray_cache.heuristic", {"none", "mdir(24)"}},
                                    {"dram.model", {"DDR4-2400", "GDDR6-14000"}},
                                    {"l2.capacity", {"16KiB", "64KiB"}},
                                    {"l2.mode", {"absent", "perfect"}},
                                    {"l2.banks", {"1", "8"}},
                                    {"l2.sectors", {"2", "4"}},
                                    {"l2.ports", {"2", "3"}},
                                    {"l2.mshrs", {"1", "2"}},
                                    {"l2.mshr_targets", {"1", "2"}},
                                    {"l2.replacement", {"plru", "fifo", "random"}},
                                    {"l2.write_policy", {"through"}},
                                    {"l2.write_allocate", {"true"}},
                                    {"l2.write_buffer", {"1", "3"}},
                                    {"crossbar.request_width", {"4", "16"}},
                                    {"crossbar.response_width", {"2", "16"}},
                                    {"node_cache.sectors", {"4"}},
                                    {"node_cache.mshr_targets", {"1"}},
                                    {"triangle_cache.sectors", {"4"}},
                                    {"triangle_cache.banks", {"2"}},
                                    {"triangle_cache.ports", {"2"}},
                                    {"triangle_cache.mshrs", {"1", "3"}},
                                    {"attribute_cache.sectors", {"4"}},
                                    {"attribute_cache.banks", {"4"}},
                                    {"attribute_cache.mshr_targets", {"1", "2"}},
                                    {"film_cache.sectors", {"4"}},
                                    {"film_cache.line", {"64"}},
                                    {"film_cache.capacity", {"1KiB"}},
                                    {"film_cache.mode", {"absent"}},
                                    {"film_cache.write_policy", {"through"}},
                                    {"film_cache.write_allocate", {"false"}},
                                    {"film_cache.write_buffer", {"1", "4"}}};
  Random random(seed);
  // Sectors of the L2 are never smaller than those of the private caches.
  Settings settings{"flow.spill_queue=48", "l2.line=256"};
  for (const Option& option : options) {
    const std::uint64_t choice = random.below(2 * option.values.size());
    if (choice >= option.values.size()) continue;
    settings.push_back(std::string(option.key) + '=' + option.values[choice]);
  }
  return settings;
}

class ClockedCombinations : public testing::TestWithParam<std::uint64_t> {};

TEST_P(ClockedCombinations, TimedEqualsClockedInEveryCounter) {
  const Settings machine = random_machine(GetParam());
  SCOPED_TRACE(testing::PrintToString(machine));
  const TestScene scene(committed_scene("dragon"), kSmall);
  expect_equal(scene, machine);
}

INSTANTIATE_TEST_SUITE_P(Random, ClockedCombinations, testing::Range<std::uint64_t>(0, 24));

TEST(Clocked, CutRunsAreAsLongAsTheirLimit) {
  const TestScene scene(committed_scene("sponza"), kSmall);
  for (const char* fidelity : {"run.fidelity=timed", "run.fidelity=clocked"}) {
    const Outcome outcome = scene.run({fidelity, "run.max_cycles=12345"});
    EXPECT_EQ(outcome.error, "");
    EXPECT_FALSE(outcome.complete);
    EXPECT_EQ(outcome.count("system.cycles"), 12345U);
  }
}

}  // namespace
}  // namespace sheaf::test
