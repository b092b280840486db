// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// What a scene does not need is left out, and that changes nothing else: forcing everything in
// gives the same picture and the same counters for what remains.

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"
#include "support/simulate.h"
#include "support/tiny_gltf.h"

namespace sheaf::test {
namespace {

const Settings kSmallImage{"image.width=48", "image.height=40", "image.heat_maps=node_visits"};

/// Runs with and without run.keep_all; `left_out` are prefixes of counters that only the latter
/// may lack.
void expect_nothing_else_changes(const std::filesystem::path& file, const Settings& settings,
                                 const std::vector<std::string>& left_out) {
  Settings base = kSmallImage;
  base.insert(base.end(), settings.begin(), settings.end());
  const TestScene scene(file, base);
  const Outcome lean = scene.run();
  const Outcome all = scene.run({"run.keep_all=true"});
  ASSERT_EQ(lean.error + all.error, "");
  EXPECT_EQ(lean.image, all.image);
  for (const auto& [path, entry] : lean.stats.items()) {
    if (path == "system.num_wakes") continue;  // the simulator's work, not the machine's
    ASSERT_TRUE(all.stats.contains(path)) << path;
    EXPECT_EQ(entry, all.stats.at(path)) << path;
  }
  for (const std::string& prefix : left_out) {
    EXPECT_EQ(lean.entries({prefix}).size(), 0U) << prefix << " should have been left out";
    EXPECT_NE(all.entries({prefix}).size(), 0U) << prefix << " should have been forced in";
  }
}

TEST(LeavingOut, TexturesChangesNothingElse) {
  expect_nothing_else_changes(committed_scene("dragon"), {},
                              {"system.shader_unit0.texture_cache."});
}

TEST(LeavingOut, RefractionChangesNothingElse) {
  expect_nothing_else_changes(committed_scene("newtree"), {"render.recursion_level=2"}, {});
}

TEST(LeavingOut, BouncesChangesNothingElse) {
  expect_nothing_else_changes(committed_scene("fairy"), {"render.recursion_level=0"}, {});
}

TEST(LeavingOut, LightsChangesNothingElse) {
  const ScratchFolder scratch;
  expect_nothing_else_changes(TinyGltf().write(scratch.path()), {"render.recursion_level=3"}, {});
}

TEST(LeavingOut, PicturesChangesNoCounter) {
  const ScratchFolder scratch;
  std::vector<std::string> run =
      run_arguments(committed_scene("dragon"), scratch / "with", kSmallImage);
  ASSERT_EQ(run_sheaf(run).exit_code, 0);
  run = run_arguments(committed_scene("dragon"), scratch / "without", kSmallImage);
  run.emplace_back("--no-images");
  ASSERT_EQ(run_sheaf(run).exit_code, 0);
  EXPECT_EQ(read_bytes(scratch / "with" / "stats.json"),
            read_bytes(scratch / "without" / "stats.json"));
  const auto has = [&](const char* folder, const char* file) {
    return std::filesystem::exists(scratch / folder / file);
  };
  for (const char* picture : {"image.png", "image.exr", "heat_node_visits.png"}) {
    EXPECT_TRUE(has("with", picture)) << picture;
    EXPECT_FALSE(has("without", picture)) << picture;
  }
}

TEST(LeavingOut, IsTheRuleForAShaderCacheThatIsNotAskedFor) {
  const TestScene scene(committed_scene("sponza"), kSmallImage);
  const std::vector<std::string> of_shader_cache{"system.shader_cache.",
                                                 "system.link.shader_cache_to_shader_unit0."};
  const Outcome without = scene.run();
  EXPECT_EQ(without.entries(of_shader_cache).size(), 0U);
  const Outcome with = scene.run({"shader_cache.cells=4"});
  ASSERT_EQ(with.error, "");
  EXPECT_NE(with.entries(of_shader_cache).size(), 0U);
  EXPECT_LT(with.count("system.shader_cache.sum_materials_out"),
            with.count("system.shader_cache.sum_materials_in"));
}

TEST(LeavingOut, AllSecondaryRaysChangesNothingElse) {
  const ScratchFolder scratch;
  expect_nothing_else_changes(TinyGltf().write(scratch.path()), {"render.recursion_level=0"},
                              {"system.packet_fifo.", "system.ray_cache.",
                               "system.link.spawned_rays.", "trace.secondary."});
}

TEST(LeavingOut, AllSecondaryRaysOfTheUnsortedMachineChangesNothingElse) {
  const ScratchFolder scratch;
  expect_nothing_else_changes(
      TinyGltf().write(scratch.path()),
      {"render.recursion_level=0", "ray_cache.heuristic=none", "flow.control=credits"},
      {"system.packet_fifo.", "system.spawn_router.", "trace.secondary."});
}

}  // namespace
}  // namespace sheaf::test
