// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "stats/counters.h"

namespace sheaf {

/// No value: a ratio of nothing to nothing, or what is not known.
using StatsValue = std::variant<std::monostate, std::uint64_t, double, std::string>;

/// One line of a report.
struct StatsEntry {
  std::string path;  ///< dotted, as in system.ray_cache.num_hits
  StatsValue value;
  std::string unit;
  std::string meaning;
};

/// Everything a run reports, in the order in which it was added. A path stands in it once: adding
/// one again is a mistake of the caller and throws std::logic_error.
class StatsTree {
 public:
  void add(std::string path, std::uint64_t value, std::string_view unit, std::string_view meaning);

  /// A value that is there but not finite is a bug of what made it: throws std::logic_error.
  void add_real(std::string path, std::optional<double> value, std::string_view unit,
                std::string_view meaning);

  /// numerator / denominator; none if the denominator is zero.
  template <typename Number>
  void add_ratio(std::string path, Number numerator, Number denominator, std::string_view unit,
                 std::string_view meaning) {
    add_quotient(std::move(path), static_cast<double>(numerator), static_cast<double>(denominator),
                 unit, meaning);
  }

  void add_text(std::string path, std::string value, std::string_view meaning);

  // The same of a declared value, as `prefix.name`.
  void add(std::string_view prefix, const CounterInfo& info, std::uint64_t value) {
    add(path_of(prefix, info), value, info.unit, info.meaning);
  }
  void add_real(std::string_view prefix, const CounterInfo& info, std::optional<double> value) {
    add_real(path_of(prefix, info), value, info.unit, info.meaning);
  }
  template <typename Number>
  void add_ratio(std::string_view prefix, const CounterInfo& info, Number numerator,
                 Number denominator) {
    add_ratio(path_of(prefix, info), numerator, denominator, info.unit, info.meaning);
  }
  void add_text(std::string_view prefix, const CounterInfo& info, std::string value) {
    add_text(path_of(prefix, info), std::move(value), info.meaning);
  }

  /// Every counter of a SHEAF_STATS struct or a StallAccount as `prefix.name`.
  template <typename Stats>
  void add_counters(std::string_view prefix, const Stats& stats) {
    stats.for_each([&](const CounterInfo& info, std::uint64_t value) {
      add(std::string(prefix) + '.' + std::string(info.name), value, info.unit, info.meaning);
    });
  }

  [[nodiscard]] const std::vector<StatsEntry>& entries() const { return entries_; }

  /// The entry of a path; nullptr if there is none.
  [[nodiscard]] const StatsEntry* find(const std::string& path) const;

  /// The value of a counter; throws std::out_of_range if the path is unknown or no counter.
  [[nodiscard]] std::uint64_t count(const std::string& path) const;

 private:
  static std::string path_of(std::string_view prefix, const CounterInfo& info) {
    return std::string(prefix) + '.' + std::string(info.name);
  }
  void add_quotient(std::string path, double numerator, double denominator, std::string_view unit,
                    std::string_view meaning);
  void add_entry(StatsEntry entry);

  std::vector<StatsEntry> entries_;
  std::unordered_map<std::string, std::size_t> index_;
};

}  // namespace sheaf
