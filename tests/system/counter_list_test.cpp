// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Everything that a run reports is explained by `sheaf counters`.

#include <gtest/gtest.h>

#include "support/listed_counters.h"
#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::test {
namespace {

TEST(CounterList, ExplainsEverythingThatARunReports) {
  const ListedCounters listed;
  ASSERT_GT(listed.size(), 100U);
  const ScratchFolder scratch;
  const std::vector<std::string> small{"image.width=32", "image.height=24",
                                       "render.recursion_level=2", "measure.coherence=true"};
  int runs = 0;
  for (const std::vector<std::string>& choice : std::vector<std::vector<std::string>>{
           {"dram.model=DDR4-2400", "shader_cache.cells=4"},
           {"ray_cache.heuristic=none", "traversal.scheme=omni"},
           {"run.fidelity=sampled"},
           {"run.fidelity=analytic"},
           {"run.fidelity=functional", "render.recursion_level=0"}}) {
    std::vector<std::string> settings = small;
    settings.insert(settings.end(), choice.begin(), choice.end());
    const auto out = scratch / std::to_string(++runs);
    ASSERT_EQ(run_sheaf(run_arguments(committed_scene("fairy"), out, settings)).exit_code, 0);
    const nlohmann::json stats = read_stats(out);
    for (const auto& [path, value] : stats.items()) {
      EXPECT_TRUE(listed.has(path)) << path;
    }
  }
}

}  // namespace
}  // namespace sheaf::test
