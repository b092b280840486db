// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Every queue of depth 1, one context, one cell, one unit of each kind, one outstanding line: the
// machine finishes, with the picture of a large one.

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/simulate.h"
#include "units/flow_control.h"

namespace sheaf::test {
namespace {

const Settings kSmallExactImage{"image.width=48", "image.height=40", "render.recursion_level=2",
                                "film.format=exact"};

Settings smallest_machine() {
  Settings settings{"ray_cache.cells=1",   "ray_cache.rays_per_cycle=1",
                    "packet_fifo.depth=1", "link.depth=1",
                    "link.memory_width=1", "l2.banks=1",
                    "l2.mshrs=1",          "l2.ways=1",
                    "l2.capacity=64",      "dram.bytes_per_cycle=1"};
  for (const char* unit : {"traversal_unit", "intersection_unit", "shader_unit"}) {
    for (const char* parameter : {"count", "contexts", "lanes"}) {
      settings.push_back(std::string(unit) + '.' + parameter + "=1");
    }
  }
  for (const char* cache :
       {"node_cache", "triangle_cache", "attribute_cache", "texture_cache", "film_cache"}) {
    settings.push_back(std::string(cache) + ".mshrs=1");
    settings.push_back(std::string(cache) + ".ways=1");
    settings.push_back(std::string(cache) + ".capacity=64");
  }
  return settings;
}

/// The fewest credits with which a primary packet of this many rays is ever admitted.
std::string fewest_credits(const TestScene& scene, std::uint64_t packet_size) {
  const SceneNeeds& needs = scene.prepared().scene.needs;
  const WorstCase worst(scene.base().render.recursion_level,
                        static_cast<std::uint32_t>(scene.prepared().scene.lights.size()),
                        (needs.reflection ? 1U : 0U) + (needs.refraction ? 1U : 0U));
  return "flow.credits=" + std::to_string(worst.of({}) * packet_size);
}

class SmallestMachine : public testing::TestWithParam<const char*> {};

TEST_P(SmallestMachine, FinishesWithTheSamePicture) {
  const TestScene scene(committed_scene(GetParam()), kSmallExactImage);
  const Outcome large = scene.run();
  const std::vector<Settings> machines{
      {"flow.control=tile"},
      {"flow.control=tile", "ray_cache.heuristic=opos"},
      {"flow.control=tile", "ray_cache.heuristic=grid(4)", "ray_cache.group_by_kind=true"},
      {"flow.control=tile", "ray_cache.order=breadth_first", "shader_cache.cells=1"},
      {"flow.control=credits", fewest_credits(scene, 16), "shader_cache.cells=1"},
      {"flow.control=credits", fewest_credits(scene, 16), "shader_cache.cells=1",
       "ray_cache.heuristic=none"},
      {"flow.control=credits", fewest_credits(scene, 16)},
      {"flow.control=credits", fewest_credits(scene, 16), "ray_cache.heuristic=none"},
      {"flow.control=credits", fewest_credits(scene, 1), "packet.size=1"},
      {"flow.control=spill", "flow.spill_queue=1"},
      {"flow.control=spill", "flow.spill_queue=1", "ray_cache.heuristic=none", "packet.size=1"},
      {"flow.control=spill", "flow.spill_queue=1", "shader_cache.cells=1",
       "film_cache.write_buffer=1", "l2.write_buffer=1", "l2.mshr_targets=1",
       "film_cache.mshr_targets=1", "crossbar.request_width=1", "crossbar.response_width=1",
       "crossbar.depth=1"},
      {"node_cache.mode=absent", "triangle_cache.mode=absent", "attribute_cache.mode=absent",
       "texture_cache.mode=absent", "film_cache.mode=absent", "l2.mode=absent"}};
  for (const Settings& machine : machines) {
    Settings settings = smallest_machine();
    settings.insert(settings.end(), machine.begin(), machine.end());
    const Outcome outcome = scene.run(settings);
    EXPECT_EQ(outcome.error, "") << testing::PrintToString(machine);
    EXPECT_TRUE(outcome.complete) << testing::PrintToString(machine);
    EXPECT_TRUE(outcome.image == large.image) << testing::PrintToString(machine);
    EXPECT_EQ(outcome.entries({"rays."}), large.entries({"rays."}));
  }
}

INSTANTIATE_TEST_SUITE_P(Committed, SmallestMachine, testing::ValuesIn(kCommittedScenes),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace sheaf::test
