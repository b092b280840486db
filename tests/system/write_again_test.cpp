// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// What a command has written, any command may replace: it leaves its own files there and no others.

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

std::string committed_trace(const std::string& name) {
  const fs::path root = committed_scene("sponza").parent_path().parent_path();
  return (root / "traces" / (name + ".trace")).string();
}

/// Every command that writes a folder, as richly as it can.
std::map<std::string, Words> commands() {
  const std::string scene = committed_scene("fairy").string();
  const Words small{"--set", "image.width=32", "--set", "image.height=24"};
  std::map<std::string, Words> all{
      {"run",
       {"run", scene, "--record", "rays", "--record", "memory", "--timeline", "--set",
        "image.heat_maps=rays,node_visits,triangle_tests"}},
      {"plain run", {"run", scene, "--no-images"}},
      {"accuracy", {"accuracy", scene, "--reference", "timed"}},
      {"replay of rays",
       {"replay", committed_trace("sponza-rays"), "--scene", committed_scene("sponza").string()}},
      {"replay of memory", {"replay", committed_trace("dragon-memory")}},
      {"curve", {"curve", committed_trace("dragon-memory")}},
      {"stability", {"stability", "--quick", "--only", "sums/no numbers"}}};
  for (const char* name : {"run", "plain run", "accuracy"}) {
    all[name].insert(all[name].end(), small.begin(), small.end());
  }
  return all;
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

TEST(WriteAgain, LeavesNothingOfWhatAnyCommandWroteBefore) {
  const ScratchFolder scratch;
  std::map<std::string, std::set<std::string>> written;
  for (auto [name, command] : commands()) {
    command.insert(command.end(), {"--out", (scratch / name).string()});
    for (int time = 0; time < 2; ++time) {
      const CommandResult result = run_sheaf(command);
      ASSERT_EQ(result.exit_code, 0) << name << ": " << result.err;
    }
    written[name] = names_in(scratch / name);
  }
  EXPECT_GE(written["run"].size(), 11U);
  for (const auto& [name, files] : written) {
    Words next = commands().at("plain run");
    next.insert(next.end(), {"--out", (scratch / name).string()});
    const CommandResult result = run_sheaf(next);
    ASSERT_EQ(result.exit_code, 0) << name << ": " << result.err;
    EXPECT_EQ(names_in(scratch / name), written["plain run"]) << "after " << name;
  }
}

}  // namespace
}  // namespace sheaf::test
