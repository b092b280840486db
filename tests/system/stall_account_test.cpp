// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Every cycle of every unit goes to one cause, whatever the machine, the fidelity and the length of
// the run; and a run that is cut has the length that was asked for.

#include <gtest/gtest.h>

#include <map>

#include "support/scenes.h"
#include "support/simulate.h"

namespace sheaf::test {
namespace {

/// Sums of the stall accounts, by unit.
std::map<std::string, std::uint64_t> account_sums(const Outcome& outcome) {
  std::map<std::string, std::uint64_t> sums;
  for (const auto& [path, entry] : outcome.stats.items()) {
    const std::size_t at = path.find(".stall_cycles_");
    if (at != std::string::npos) {
      sums[path.substr(0, at)] += entry.at("value").get<std::uint64_t>();
    }
  }
  return sums;
}

class StallAccounts : public testing::TestWithParam<Settings> {};

TEST_P(StallAccounts, SumToTheLengthOfTheRun) {
  const TestScene scene(committed_scene("fairy"), {"image.width=32", "image.height=24"});
  for (const char* fidelity : {"timed", "clocked"}) {
    for (const std::uint64_t limit : {0, 1, 2, 100, 5000, 20001}) {
      Settings settings = GetParam();
      settings.push_back(std::string("run.fidelity=") + fidelity);
      settings.push_back("run.max_cycles=" + std::to_string(limit));
      const Outcome outcome = scene.run(settings);
      ASSERT_EQ(outcome.error, "");
      const std::uint64_t cycles = outcome.count("system.cycles");
      EXPECT_EQ(outcome.complete, limit == 0);
      EXPECT_EQ(cycles, limit == 0 ? cycles : limit) << fidelity;
      const auto sums = account_sums(outcome);
      EXPECT_GE(sums.size(), 7U);
      for (const auto& [unit, sum] : sums) {
        EXPECT_EQ(sum, cycles) << unit << ", " << fidelity << ", limit " << limit;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Machines, StallAccounts,
    testing::Values(Settings{}, Settings{"ray_cache.heuristic=none", "flow.control=credits"},
                    Settings{"shader_cache.cells=4", "dram.model=DDR4-2400"},
                    Settings{"link.depth=1", "packet_fifo.depth=1", "traversal_unit.count=3",
                             "intersection_unit.count=3", "shader_unit.count=2"},
                    Settings{"dram.latency=3000", "node_cache.mshrs=1"}));

}  // namespace
}  // namespace sheaf::test
