// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace sheaf::test {

/// The paths that `sheaf counters` lists: "system.<unit><n>" stands for every unit.
class ListedCounters {
 public:
  ListedCounters();

  [[nodiscard]] bool has(const std::string& path) const;
  /// Whether there are counters below a path, such as system.dram.
  [[nodiscard]] bool has_group(const std::string& path) const;
  [[nodiscard]] std::size_t size() const { return paths_.size(); }

 private:
  std::vector<std::regex> paths_;
  std::vector<std::regex> groups_;
};

}  // namespace sheaf::test
