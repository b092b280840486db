// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "base/text.h"
#include "config/config_text.h"
#include "config/parameters.h"
#include "config/quantities.h"

namespace sheaf {
namespace {

constexpr std::string_view kOff = "off";

bool is_off(const RawValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr && *text == kOff;
}

/// The value as a message shows it.
std::string shown(const RawValue& value) {
  return std::visit(
      [](const auto& v) -> std::string {
        using V = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<V, std::string>) {
          return toml_string(printable(v));
        } else if constexpr (std::is_same_v<V, std::vector<double>>) {
          return fmt::format("an array of {}", v.size());
        } else if constexpr (std::is_same_v<V, UnsupportedValue>) {
          return v.type;
        } else {
          return fmt::format("{}", v);
        }
      },
      value);
}

std::string expected(std::string_view what, const RawValue& value) {
  return fmt::format("expected {}, got {}", what, shown(value));
}

/// A real number. Adding zero turns -0 into +0, which TOML's integers cannot tell apart.
std::optional<double> as_real(const RawValue& value) {
  if (const auto* real = std::get_if<double>(&value)) return *real + 0.0;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return std::nullopt;
}

/// A whole number at or above zero; 1e6 counts as whole. Reals are exact only below 2^53.
std::optional<std::uint64_t> as_count(const RawValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    return *whole < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(*whole));
  }
  const auto* real = std::get_if<double>(&value);
  if (real == nullptr || !(*real >= 0 && *real <= 0x1p53) || std::trunc(*real) != *real) {
    return std::nullopt;
  }
  return static_cast<std::uint64_t>(*real);
}

std::optional<Triple> as_triple(const RawValue& value) {
  const auto* array = std::get_if<std::vector<double>>(&value);
  if (array == nullptr || array->size() != 3) return std::nullopt;
  return Triple{(*array)[0] + 0.0, (*array)[1] + 0.0, (*array)[2] + 0.0};
}

/// Empty if the number, each number of a triple, is within the parameter's range. Written so that
/// NaN is outside.
std::string check_range(const Parameter& parameter, double number, const RawValue& value) {
  if (number >= parameter.lowest && number <= parameter.highest) return {};
  return fmt::format("{} is out of range; allowed: {}", shown(value), parameter.range_text());
}

std::string check_range(const Parameter& parameter, std::uint64_t number, const RawValue& value) {
  return check_range(parameter, static_cast<double>(number), value);
}

std::string check_range(const Parameter& parameter, const Triple& triple, const RawValue&) {
  for (const double number : {triple.x, triple.y, triple.z}) {
    std::string problem = check_range(parameter, number, number);
    if (!problem.empty()) return problem;
  }
  return {};
}

/// Makes `parameter` assign to `field` and show it: `read` gives a value of the field's type or
/// nothing (then `what` was expected), `show` its TOML text. An optional field can also be "off".
template <typename Field, typename Read, typename Show>
Parameter bind(Parameter parameter, Field& field, const std::string& what, Read read, Show show) {
  constexpr bool kOptional = requires {
    field.reset();
  };
  parameter.optional = kOptional;
  const std::string wanted = kOptional ? what + " or \"off\"" : what;
  const auto assign = [parameter, &field, wanted, read](const RawValue& value) -> std::string {
    if constexpr (kOptional) {
      if (is_off(value)) {
        field.reset();
        return {};
      }
    }
    const auto number = read(value);
    if (!number) return expected(wanted, value);
    std::string problem = check_range(parameter, *number, value);
    if (problem.empty()) field = *number;
    return problem;
  };
  parameter.assign = assign;
  parameter.current = [&field, show]() -> std::string {
    if constexpr (kOptional) {
      return field ? show(*field) : toml_string(kOff);
    } else {
      return show(field);
    }
  };
  return parameter;
}

std::optional<Bytes> as_bytes(const RawValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? parse_bytes(*text) : as_count(value);
}

std::optional<double> as_frequency(const RawValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? parse_frequency(*text) : as_real(value);
}

std::string real_text(double real) {
  return fmt::format("{}", real);
}
std::string triple_text(const Triple& t) {
  return fmt::format("[{}, {}, {}]", t.x, t.y, t.z);
}

constexpr const char* kThreeNumbers = "three numbers [x, y, z]";

// Positions further out than this cannot be told apart from each other in the single precision of
// the modelled hardware, and their squared distances would overflow.
constexpr double kFarthestPosition = 1e18;

}  // namespace

std::string Parameter::range_text() const {
  const std::string in_unit = unit.empty() || unit == "1" ? "" : ' ' + unit;
  const std::string_view or_off = optional ? "off, or " : "";
  switch (type) {
    case ParameterType::kChoice:
      return fmt::format("{}", fmt::join(choices, " | "));
    case ParameterType::kFlag:
      return "true | false";
    case ParameterType::kText:
      return {};
    case ParameterType::kBytes:
      return fmt::format("{} to {}", format_bytes(static_cast<Bytes>(lowest)),
                         format_bytes(static_cast<Bytes>(highest)));
    case ParameterType::kFrequency:
      return fmt::format("{} to {}", format_frequency(lowest), format_frequency(highest));
    case ParameterType::kCount:
      return fmt::format("{} to {}{}", static_cast<std::uint64_t>(lowest),
                         static_cast<std::uint64_t>(highest), in_unit);
    case ParameterType::kReal:
      return fmt::format("{}{} to {}{}", or_off, lowest, highest, in_unit);
    case ParameterType::kTriple:
      return fmt::format("{}[x, y, z], each {} to {}{}", or_off, lowest, highest, in_unit);
  }
  return {};
}

const Parameter* ParameterTable::find(std::string_view key) const {
  const auto it = std::ranges::find(parameters_, key, &Parameter::key);
  return it == parameters_.end() ? nullptr : &*it;
}

void ParameterTable::add(Parameter parameter) {
  parameter.default_text = parameter.current();
  parameters_.push_back(std::move(parameter));
}

void ParameterTable::choice_by_index(Parameter parameter, std::function<void(std::size_t)> set,
                                     std::function<std::size_t()> get) {
  const std::vector<std::string> choices = parameter.choices;
  parameter.assign = [choices, set = std::move(set)](const RawValue& value) -> std::string {
    if (const auto* text = std::get_if<std::string>(&value)) {
      const auto it = std::ranges::find(choices, *text);
      if (it != choices.end()) {
        set(static_cast<std::size_t>(it - choices.begin()));
        return {};
      }
    }
    return expected(fmt::format("one of {}", fmt::join(choices, ", ")), value);
  };
  parameter.current = [choices, get = std::move(get)] { return toml_string(choices.at(get())); };
  add(std::move(parameter));
}

void ParameterTable::count_by_value(Parameter parameter, std::function<void(std::uint64_t)> set,
                                    std::function<std::uint64_t()> get) {
  parameter.assign = [p = parameter, set = std::move(set)](const RawValue& value) -> std::string {
    const auto number = as_count(value);
    if (!number) return expected("a whole number of " + p.range_text(), value);
    std::string problem = check_range(p, *number, value);
    if (problem.empty()) set(*number);
    return problem;
  };
  parameter.current = [get = std::move(get)] { return fmt::format("{}", get()); };
  add(std::move(parameter));
}

void ParameterTable::flag(std::string key, bool& field, bool default_value, std::string meaning) {
  field = default_value;
  add({.key = std::move(key),
       .type = ParameterType::kFlag,
       .meaning = std::move(meaning),
       .assign = [&field](const RawValue& value) -> std::string {
         const auto* flag = std::get_if<bool>(&value);
         if (flag == nullptr) return expected("true or false", value);
         field = *flag;
         return {};
       },
       .current = [&field] { return std::string(field ? "true" : "false"); }});
}

void ParameterTable::text(std::string key, std::string& field, std::string default_value,
                          std::string meaning) {
  field = std::move(default_value);
  add({.key = std::move(key),
       .type = ParameterType::kText,
       .meaning = std::move(meaning),
       .assign = [&field](const RawValue& value) -> std::string {
         const auto* text = std::get_if<std::string>(&value);
         if (text == nullptr) return expected("a text", value);
         field = *text;
         return {};
       },
       .current = [&field] { return toml_string(field); }});
}

void ParameterTable::real(std::string key, double& field, double default_value, double lowest,
                          double highest, std::string unit, std::string meaning) {
  field = default_value;
  add(bind({.key = std::move(key),
            .type = ParameterType::kReal,
            .unit = std::move(unit),
            .meaning = std::move(meaning),
            .lowest = lowest,
            .highest = highest},
           field, "a number", as_real, real_text));
}

void ParameterTable::optional_real(std::string key, std::optional<double>& field, double lowest,
                                   double highest, std::string unit, std::string meaning) {
  field.reset();
  add(bind({.key = std::move(key),
            .type = ParameterType::kReal,
            .unit = std::move(unit),
            .meaning = std::move(meaning),
            .lowest = lowest,
            .highest = highest},
           field, "a number", as_real, real_text));
}

void ParameterTable::triple(std::string key, Triple& field, Triple default_value, double lowest,
                            double highest, std::string unit, std::string meaning) {
  field = default_value;
  add(bind({.key = std::move(key),
            .type = ParameterType::kTriple,
            .unit = std::move(unit),
            .meaning = std::move(meaning),
            .lowest = lowest,
            .highest = highest},
           field, kThreeNumbers, as_triple, triple_text));
}

void ParameterTable::optional_triple(std::string key, std::optional<Triple>& field,
                                     std::string unit, std::string meaning) {
  field.reset();
  add(bind({.key = std::move(key),
            .type = ParameterType::kTriple,
            .unit = std::move(unit),
            .meaning = std::move(meaning),
            .lowest = -kFarthestPosition,
            .highest = kFarthestPosition},
           field, kThreeNumbers, as_triple, triple_text));
}

void ParameterTable::bytes(std::string key, Bytes& field, Bytes default_value, Bytes lowest,
                           Bytes highest, std::string meaning) {
  field = default_value;
  add(bind({.key = std::move(key),
            .type = ParameterType::kBytes,
            .meaning = std::move(meaning),
            .lowest = static_cast<double>(lowest),
            .highest = static_cast<double>(highest)},
           field, "a size such as \"32KiB\" or a number of bytes", as_bytes,
           [](Bytes value) { return toml_string(format_bytes(value)); }));
}

void ParameterTable::frequency(std::string key, double& field, double default_value, double lowest,
                               double highest, std::string meaning) {
  field = default_value;
  add(bind({.key = std::move(key),
            .type = ParameterType::kFrequency,
            .meaning = std::move(meaning),
            .lowest = lowest,
            .highest = highest},
           field, "a frequency such as \"1.5GHz\" or a number of hertz", as_frequency,
           [](double value) { return toml_string(format_frequency(value)); }));
}

}  // namespace sheaf
