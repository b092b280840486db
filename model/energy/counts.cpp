// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/counts.h"

#include <fmt/format.h>

namespace sheaf {

Count Counts::of(const std::string& path) const {
  const StatsEntry* entry = stats_.find(path);
  if (entry == nullptr) return {};
  if (const auto* count = std::get_if<std::uint64_t>(&entry->value)) {
    return static_cast<double>(*count);
  }
  const auto* real = std::get_if<double>(&entry->value);
  return real != nullptr ? Count(*real) : Count();
}

Count Counts::all(std::string_view unit, std::string_view counter) const {
  Count sum;
  for (int i = 0;; ++i) {
    const Count one = of(fmt::format("system.{}{}.{}", unit, i, counter));
    if (!one) return sum;
    sum = sum.value_or(0) + *one;
  }
}

Count Counts::traced(std::string_view counter) const {
  const Count primary = of(fmt::format("trace.primary.{}", counter));
  const Count secondary = of(fmt::format("trace.secondary.{}", counter));
  return primary ? Count(*primary + secondary.value_or(0)) : Count();
}

Count Counts::rays(std::string_view kind, std::string_view counter) const {
  const std::string prefix = fmt::format("rays.{}.", kind);
  const std::string suffix = fmt::format(".{}", counter);
  double sum = 0;
  for (const StatsEntry& entry : stats_.entries()) {
    if (!entry.path.starts_with(prefix) || !entry.path.ends_with(suffix)) continue;
    sum += static_cast<double>(std::get<std::uint64_t>(entry.value));
  }
  return sum;
}

}  // namespace sheaf
