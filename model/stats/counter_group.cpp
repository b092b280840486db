// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/counter_group.h"

#include <fmt/format.h>

#include <algorithm>

namespace sheaf {

std::string print_counters(std::span<const CounterGroup> groups) {
  std::size_t name_width = 0;
  std::size_t unit_width = 0;
  for (const CounterGroup& group : groups) {
    for (const CounterInfo& info : group.infos) {
      name_width = std::max(name_width, info.name.size());
      unit_width = std::max(unit_width, info.unit.size());
    }
  }
  std::string out;
  for (const CounterGroup& group : groups) {
    out += fmt::format("{}{}\n  {}\n", out.empty() ? "" : "\n", group.path, group.description);
    for (const CounterInfo& info : group.infos) {
      out += fmt::format("  .{:<{}}  {:<{}}  {}\n", info.name, name_width, info.unit, unit_width,
                         info.meaning);
    }
  }
  return out;
}

}  // namespace sheaf
