// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "support/listed_counters.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

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

bool any_matches(const std::vector<std::regex>& patterns, const std::string& text) {
  return std::ranges::any_of(
      patterns, [&](const std::regex& pattern) { return std::regex_match(text, pattern); });
}

}  // namespace

// A line at the margin begins a group, one that begins with a dot is a name in it.
ListedCounters::ListedCounters() {
  const CommandResult result = run_sheaf({"counters"});
  if (result.exit_code != 0) throw std::runtime_error("sheaf counters failed");
  std::vector<std::string> groups;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (line[0] != ' ') {
      groups.clear();
      std::istringstream alternatives(replace_all(line, ", ", ","));
      for (std::string group; std::getline(alternatives, group, ',');) groups.push_back(group);
      if (line == "left_out.<part>") paths_.emplace_back(pattern_of(line));
      for (const std::string& group : groups) groups_.emplace_back(pattern_of(group));
    } else if (line.starts_with("  .")) {
      const std::string name = line.substr(2, line.find(' ', 2) - 2);
      for (const std::string& group : groups) paths_.emplace_back(pattern_of(group + name));
    }
  }
}

bool ListedCounters::has(const std::string& path) const {
  return any_matches(paths_, path);
}

bool ListedCounters::has_group(const std::string& path) const {
  return any_matches(groups_, path);
}

}  // namespace sheaf::test
