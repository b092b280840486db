// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "stats/counters.h"

namespace sheaf {

/// The counters of one kind of unit, for `sheaf counters`.
struct CounterGroup {
  std::string_view path;         ///< as reported, for example "system.traversal_unit.<n>"
  std::string_view description;  ///< what is counted there, and when the group is left out
  std::span<const CounterInfo> infos;
};

/// What `sheaf counters` prints: each group's path and description, then its counters with unit and
/// meaning, in aligned columns.
[[nodiscard]] std::string print_counters(std::span<const CounterGroup> groups);

}  // namespace sheaf
