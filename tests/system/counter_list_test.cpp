// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Everything that a run reports is explained by `sheaf counters`.

#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::test {
namespace {

std::string replace_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// "system.<unit><n>" as a pattern of paths.
std::string pattern_of(std::string text) {
  text = replace_all(text, ".", "\\.");
  text = replace_all(text, "<n>", "\\d+");
  return std::regex_replace(text, std::regex("<[a-z ]+>"), "[A-Za-z0-9_]+");
}

/// The paths that `sheaf counters` lists: a line at the margin begins a group, one that begins with
/// a dot is a name in it.
std::vector<std::regex> listed_paths() {
  const CommandResult result = run_sheaf({"counters"});
  EXPECT_EQ(result.exit_code, 0);
  std::vector<std::regex> paths;
  std::vector<std::string> groups;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (line[0] != ' ') {
      groups.clear();
      std::istringstream alternatives(replace_all(line, ", ", ","));
      for (std::string group; std::getline(alternatives, group, ',');) groups.push_back(group);
      if (line == "left_out.<part>") paths.emplace_back(pattern_of(line));
    } else if (line.starts_with("  .")) {
      const std::string name = line.substr(2, line.find(' ', 2) - 2);
      for (const std::string& group : groups) paths.emplace_back(pattern_of(group + name));
    }
  }
  return paths;
}

TEST(CounterList, ExplainsEverythingThatARunReports) {
  const std::vector<std::regex> listed = listed_paths();
  ASSERT_GT(listed.size(), 100U);
  const ScratchFolder scratch;
  const std::vector<std::string> small{"image.width=32", "image.height=24",
                                       "render.recursion_level=2", "measure.coherence=true"};
  int runs = 0;
  for (const std::vector<std::string>& choice : std::vector<std::vector<std::string>>{
           {"dram.model=DDR4-2400", "shader_cache.cells=4"},
           {"ray_cache.heuristic=none", "traversal.scheme=omni"},
           {"run.fidelity=functional", "render.recursion_level=0"}}) {
    std::vector<std::string> settings = small;
    settings.insert(settings.end(), choice.begin(), choice.end());
    const auto out = scratch / std::to_string(++runs);
    ASSERT_EQ(run_sheaf(run_arguments(committed_scene("fairy"), out, settings)).exit_code, 0);
    const nlohmann::json stats = read_stats(out);
    for (const auto& [path, value] : stats.items()) {
      const bool known = std::any_of(listed.begin(), listed.end(), [&](const std::regex& pattern) {
        return std::regex_match(path, pattern);
      });
      EXPECT_TRUE(known) << path;
    }
  }
}

}  // namespace
}  // namespace sheaf::test
