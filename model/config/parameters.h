// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "config/config.h"

namespace sheaf {

/// Upper limits of ranges: counts that are "large" rather than "infinite", so that sums of them
/// cannot wrap in 64 bits.
inline constexpr std::uint64_t kMaxCount = std::uint64_t{1} << 48;
inline constexpr Cycles kMaxLatency = 1'000'000;
inline constexpr Bytes kMaxCacheBytes = Bytes{1} << 40;

/// A value as a configuration file or `--set` gave it, not yet checked.
struct UnsupportedValue {
  std::string type;  ///< what it was instead, for the message: "a table", "a date"
};
using RawValue =
    std::variant<bool, std::int64_t, double, std::string, std::vector<double>, UnsupportedValue>;

enum class ParameterType : std::uint8_t {
  kChoice,
  kCount,
  kFlag,
  kText,
  kReal,
  kTriple,
  kBytes,
  kFrequency
};

/// One parameter's declaration. `assign` and `current` act on the Config that the table was made
/// for, which must outlive it.
struct Parameter {
  std::string key = {};
  ParameterType type = {};
  bool optional = false;  ///< "off" is a value
  std::string unit = {};  ///< empty where the value carries its unit, or has none
  std::string meaning = {};
  std::string default_text = {};   ///< as TOML
  double lowest = 0, highest = 0;  ///< of kCount, kReal, kBytes, kFrequency, and each of kTriple
  std::vector<std::string> choices = {};  ///< of kChoice

  /// Sets the bound field; returns what is wrong with the value, empty if nothing.
  std::function<std::string(const RawValue&)> assign = {};
  /// The bound field's value as TOML text that reads back exactly.
  std::function<std::string()> current = {};

  /// "1 to 16384 pixels", "16B to 1TiB", "dir | none"; empty if anything goes.
  [[nodiscard]] std::string range_text() const;
};

/// The one place where parameters are declared: parsing, checks, documentation, the resolved
/// configuration file and the JSON schema all come from it. Each declaration also sets the bound
/// field to its default.
class ParameterTable {
 public:
  template <typename Enum>
  void choice(std::string key, Enum& field, Enum default_value,
              std::vector<std::pair<std::string, Enum>> values, std::string meaning);

  /// Whole numbers of 32 or 64 bits; a range wider than the field is cut to what the field holds.
  template <typename Integer>
  void count(std::string key, Integer& field, std::type_identity_t<Integer> default_value,
             std::uint64_t lowest, std::uint64_t highest, std::string unit, std::string meaning);

  void flag(std::string key, bool& field, bool default_value, std::string meaning);
  void text(std::string key, std::string& field, std::string default_value, std::string meaning);
  void real(std::string key, double& field, double default_value, double lowest, double highest,
            std::string unit, std::string meaning);
  void optional_real(std::string key, std::optional<double>& field, double lowest, double highest,
                     std::string unit, std::string meaning);
  void triple(std::string key, Triple& field, Triple default_value, double lowest, double highest,
              std::string unit, std::string meaning);
  void optional_triple(std::string key, std::optional<Triple>& field, std::string unit,
                       std::string meaning);
  void bytes(std::string key, Bytes& field, Bytes default_value, Bytes lowest, Bytes highest,
             std::string meaning);
  void frequency(std::string key, double& field, double default_value, double lowest,
                 double highest, std::string meaning);

  [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }
  [[nodiscard]] const Parameter* find(std::string_view key) const;

 private:
  void choice_by_index(Parameter parameter, std::function<void(std::size_t)> set,
                       std::function<std::size_t()> get);
  void count_by_value(Parameter parameter, std::function<void(std::uint64_t)> set,
                      std::function<std::uint64_t()> get);
  void add(Parameter parameter);

  std::vector<Parameter> parameters_;
};

/// Declares every parameter, bound to the fields of `config`, and sets these to their defaults.
[[nodiscard]] ParameterTable declare_parameters(Config& config);

template <typename Enum>
void ParameterTable::choice(std::string key, Enum& field, Enum default_value,
                            std::vector<std::pair<std::string, Enum>> values, std::string meaning) {
  field = default_value;
  Parameter parameter{
      .key = std::move(key), .type = ParameterType::kChoice, .meaning = std::move(meaning)};
  std::vector<Enum> enums;
  for (auto& [name, value] : values) {
    parameter.choices.push_back(std::move(name));
    enums.push_back(value);
  }
  choice_by_index(
      std::move(parameter), [&field, enums](std::size_t i) { field = enums[i]; },
      [&field, enums] {
        return static_cast<std::size_t>(std::ranges::find(enums, field) - enums.begin());
      });
}

// The strings are moved, which clang-tidy 14 does not see in a template.
// NOLINTBEGIN(performance-unnecessary-value-param)
template <typename Integer>
void ParameterTable::count(std::string key, Integer& field,
                           std::type_identity_t<Integer> default_value, std::uint64_t lowest,
                           std::uint64_t highest, std::string unit, std::string meaning) {
  field = default_value;
  const std::uint64_t holds = std::numeric_limits<Integer>::max();
  count_by_value(
      {.key = std::move(key),
       .type = ParameterType::kCount,
       .unit = std::move(unit),
       .meaning = std::move(meaning),
       .lowest = static_cast<double>(lowest),
       .highest = static_cast<double>(std::min(highest, holds))},
      [&field](std::uint64_t value) { field = static_cast<Integer>(value); },
      [&field] { return std::uint64_t{field}; });
}
// NOLINTEND(performance-unnecessary-value-param)

}  // namespace sheaf
