// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"
#include "support/simulate.h"
#include "system/analytic_model.h"

namespace sheaf::test {
namespace {

struct Analytic : testing::TestWithParam<Settings> {
  const TestScene scene{committed_scene("sponza"), {"image.width=64", "image.height=48"}};
  Settings with(const std::string& fidelity) const {
    Settings settings = GetParam();
    settings.push_back("run.fidelity=" + fidelity);
    return settings;
  }
};

TEST_P(Analytic, HasThePictureAndTheTracesOfARunWithoutTime) {
  const Outcome functional = scene.run(with("functional"));
  const Outcome analytic = scene.run(with("analytic"));
  ASSERT_EQ(analytic.error, "");
  EXPECT_TRUE(analytic.image == functional.image);
  EXPECT_EQ(analytic.entries({"rays.", "trace.", "system.ray_cache."}),
            functional.entries({"rays.", "trace.", "system.ray_cache."}));
}

// Issue slots depend on no order, so that these bounds hold; misses only add to them.
TEST_P(Analytic, BoundsOfIssuePortsAreBelowTheTimedFrame) {
  const Outcome timed = scene.run(with("timed"));
  const Outcome analytic = scene.run(with("analytic"));
  ASSERT_EQ(timed.error, "");
  for (const char* bound : {"primary_source", "ray_cache", "traversal_issue", "intersection_issue",
                            "shader_issue", "film", "l2_banks", "dram_bus"}) {
    EXPECT_LT(analytic.count(std::string("bound.") + bound), timed.count("system.cycles")) << bound;
    const bool unused =
        std::string(bound) == "dram_bus" && timed.count("system.dram.num_reads") == 0;
    EXPECT_EQ(analytic.count(std::string("bound.") + bound) == 0, unused) << bound;
  }
}

const auto kMachines =
    testing::Values(Settings{}, Settings{"flow.control=credits"},
                    Settings{"dram.model=DDR4-2400", "l2.line=128", "l2.sectors=2"},
                    Settings{"film_cache.write_policy=through", "l2.mode=perfect"});
INSTANTIATE_TEST_SUITE_P(Machines, Analytic, kMachines);

// What rtl_notes/deviations.md says of these scenes and machines.
class AnalyticEstimate : public testing::TestWithParam<std::tuple<const char*, Settings>> {};

TEST_P(AnalyticEstimate, IsAsFarOffAsDocumented) {
  const auto& [name, machine] = GetParam();
  const TestScene scene(committed_scene(name), {"image.width=64", "image.height=48"});
  Settings settings = machine;
  const Outcome timed = scene.run(settings);
  settings.emplace_back("run.fidelity=analytic");
  const Outcome analytic = scene.run(settings);
  ASSERT_EQ(timed.error + analytic.error, "");
  const auto value = [](const Outcome& outcome, const char* path) {
    return outcome.stats.at(path).at("value").get<double>();
  };
  const double cycles = value(analytic, "estimate.cycles.value") / value(timed, "system.cycles");
  RecordProperty("cycles", std::to_string(cycles - 1.0));
  EXPECT_LE(cycles, 1.0 - 0.06);
  EXPECT_GE(cycles, 1.0 - 0.41);
  const double dram =
      value(timed, "system.dram.bytes_read") + value(timed, "system.dram.bytes_written");
  EXPECT_NEAR(value(analytic, "estimate.dram_bytes.value"), dram, 0.08 * dram);
}

INSTANTIATE_TEST_SUITE_P(Scenes, AnalyticEstimate,
                         testing::Combine(testing::ValuesIn(kCommittedScenes), kMachines));

// One unit of each kind and packets in the same order: the accesses of the timed machine, one by
// one, are those that the model looks up.
TEST(AnalyticAccesses, AreThoseOfTheTimedMachine) {
  const TestScene scene(
      committed_scene("sponza"),
      {"image.width=48", "image.height=32", "traversal_unit.count=1", "intersection_unit.count=1",
       "traversal_unit.contexts=1", "ray_cache.heuristic=none"});
  const Outcome timed = scene.run();
  ASSERT_EQ(timed.error, "");
  Frame frame(scene.base());
  const BuildPlan plan = plan_machine(scene.base(), scene.prepared().scene.needs);
  AnalyticModel model(scene.base(), scene.prepared());
  FunctionalPipeline pipeline(scene.base(), plan, scene.prepared(), frame, {}, &model);
  ASSERT_TRUE(model.run(pipeline, {}));
  const TileWork all = model.frame();
  const auto expect = [&](Observed what, const std::string& path) {
    EXPECT_EQ(all.seen[what], timed.count(path)) << path;
  };
  expect(Observed::kNodeAccesses, "system.traversal_unit0.node_cache.num_accesses");
  expect(Observed::kTriangleAccesses, "system.intersection_unit0.triangle_cache.num_accesses");
  expect(Observed::kAttributeAccesses, "system.shader_unit0.attribute_cache.num_accesses");
  expect(Observed::kTextureAccesses, "system.shader_unit0.texture_cache.num_accesses");
  expect(Observed::kFilmAccesses, "system.film.cache.num_accesses");
}

}  // namespace
}  // namespace sheaf::test
