// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The same inputs give the same bytes.

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::test {
namespace {

class Determinism : public testing::TestWithParam<const char*> {};

TEST_P(Determinism, TwoRunsGiveTheSameBytes) {
  const ScratchFolder scratch;
  const std::vector<std::string> settings{"image.width=64", "image.height=48",
                                          "render.recursion_level=2", "measure.coherence=true",
                                          "image.heat_maps=rays,node_visits,triangle_tests"};
  for (const char* name : {"first", "second"}) {
    const CommandResult result =
        run_sheaf(run_arguments(committed_scene(GetParam()), scratch / name, settings));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
  }
  for (const char* file : {"stats.json", "image.exr", "image.png", "config.toml", "heat_rays.png",
                           "heat_node_visits.png", "heat_triangle_tests.png"}) {
    EXPECT_EQ(read_bytes(scratch / "first" / file), read_bytes(scratch / "second" / file)) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(Committed, Determinism, testing::ValuesIn(kCommittedScenes),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace sheaf::test
