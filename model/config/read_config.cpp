// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/read_config.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <tuple>

#include "base/errors.h"
#include "base/text.h"
#include "config/check_config.h"
#include "config/config_text.h"
#include "config/parameters.h"

namespace sheaf {
namespace {

// Far more than any configuration needs.
constexpr std::size_t kLargestFile = std::size_t{1} << 20;

// Each dot of a dotted key is a level of tables, and toml++ recurses over levels without a limit of
// its own, so that a hostile file could exhaust the stack.
constexpr std::ptrdiff_t kMostDotsInLine = 32;

[[noreturn]] void refuse(std::string_view place, std::string_view problem) {
  throw Error(ExitCode::kUsage, fmt::format("{}: {}", place, problem));
}

/// How far a mistyped key is from a known one. A key without a table may just lack the table.
std::size_t key_distance(std::string_view typed, std::string_view known) {
  if (typed.find('.') == std::string_view::npos) known.remove_prefix(known.rfind('.') + 1);
  return edit_distance(typed, known);
}

std::string unknown_key(const ParameterTable& table, std::string_view key) {
  constexpr std::size_t kLongestKey = 100;
  const std::string told = fmt::format("unknown key '{}'", printable(key));
  if (key.size() <= kLongestKey) {
    const auto nearest = std::ranges::min_element(
        table.parameters(), {}, [&](const Parameter& p) { return key_distance(key, p.key); });
    if (may_be_meant(key, key_distance(key, nearest->key))) {
      return fmt::format("{}; did you mean '{}'?", told, nearest->key);
    }
  }
  return told + "; `sheaf config` lists all keys";
}

void assign(const Parameter& parameter, const RawValue& value, std::string_view place) {
  const std::string problem = parameter.assign(value);
  if (!problem.empty()) refuse(place, fmt::format("{}: {}", parameter.key, problem));
}

RawValue raw_array(const toml::array& array) {
  std::vector<double> numbers;
  for (const toml::node& element : array) {
    const auto number = element.is_number() ? element.value<double>() : std::nullopt;
    if (!number) return UnsupportedValue{"an array of other things than numbers"};
    numbers.push_back(*number);
  }
  return numbers;
}

RawValue raw_value(const toml::node& node) {
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* whole = node.as_integer()) return whole->get();
  if (const auto* real = node.as_floating_point()) return real->get();
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* array = node.as_array()) return raw_array(*array);
  return UnsupportedValue{node.is_table() ? "a table" : "a date or time"};
}

/// A key that a file gives, in the order of the file.
struct Entry {
  toml::source_position position;
  std::string key;
  const toml::node* node;
};

/// "table.name"; a name that holds a dot itself keeps its quotes.
std::string joined(const std::string& table, std::string_view name) {
  const std::string quoted =
      name.find('.') == std::string_view::npos ? std::string(name) : toml_string(name);
  return table.empty() ? quoted : table + '.' + quoted;
}

/// Steps from an unknown table to the first value in it, which says more about what was meant.
Entry first_inside(Entry entry) {
  constexpr int kDeepest = 4;
  for (int depth = 0; depth < kDeepest; ++depth) {
    const auto* table = entry.node->as_table();
    if (table == nullptr || table->empty()) break;
    const auto first = table->begin();
    entry = {first->first.source().begin, joined(entry.key, first->first.str()), &first->second};
  }
  return entry;
}

void collect(const ParameterTable& parameters, const toml::table& table, const std::string& path,
             std::vector<Entry>& entries) {
  for (const auto& [name, node] : table) {
    const Entry entry{name.source().begin, joined(path, name.str()), &node};
    const bool is_group = std::ranges::any_of(parameters.parameters(), [&](const Parameter& p) {
      return p.key.starts_with(entry.key + '.');
    });
    if (is_group && node.is_table()) {
      collect(parameters, *node.as_table(), entry.key, entries);
    } else {
      entries.push_back(parameters.find(entry.key) == nullptr ? first_inside(entry) : entry);
    }
  }
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(kLargestFile + 1, '\0');
  if (stream) stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream.is_open() || stream.bad() || std::filesystem::is_directory(file)) {
    refuse(printable(file.string()), "cannot read this configuration file");
  }
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > kLargestFile) {
    refuse(printable(file.string()), "larger than 1MiB, which no configuration is");
  }
  return text;
}

void check_nesting(std::string_view text, const std::string& place) {
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    const std::string_view content = text.substr(0, length);
    if (!content.starts_with('#') && std::ranges::count(content, '.') > kMostDotsInLine) {
      refuse(fmt::format("{}:{}", place, line), "too many dots in one line");
    }
    text.remove_prefix(std::min(length + 1, text.size()));
  }
}

void read_toml(const ParameterTable& parameters, const std::string& text,
               const std::string& place) {
  check_nesting(text, place);
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    refuse(fmt::format("{}:{}", place, error.source().begin.line),
           fmt::format("not TOML: {}", printable(error.description())));
  }
  std::vector<Entry> entries;
  collect(parameters, root, "", entries);
  std::ranges::sort(entries, {}, [](const Entry& entry) {
    return std::tuple(entry.position.line, entry.position.column);
  });
  for (const Entry& entry : entries) {
    const std::string at = fmt::format("{}:{}", place, entry.position.line);
    const Parameter* parameter = parameters.find(entry.key);
    if (parameter == nullptr) refuse(at, unknown_key(parameters, entry.key));
    assign(*parameter, raw_value(*entry.node), at);
  }
}

/// The value of "v = <text>" if that is one TOML value and nothing else.
std::optional<RawValue> parse_value(const std::string& text) {
  if (text.find('\n') != std::string::npos) return std::nullopt;
  try {
    const toml::table table = toml::parse("v = " + text);
    return raw_value(*table.get("v"));
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

RawValue setting_value(const Parameter& parameter, const std::string& text,
                       std::string_view place) {
  auto value = parse_value(text);
  if (!value && parameter.type == ParameterType::kTriple) value = parse_value('[' + text + ']');
  const bool is_text = value && std::holds_alternative<std::string>(*value);
  if (!value || (parameter.type == ParameterType::kText && !is_text)) {
    value = parse_value(toml_string(text));
    if (!value) refuse(place, "not valid UTF-8");
  }
  return *value;
}

void apply_setting(const ParameterTable& parameters, const std::string& setting) {
  const std::string place = fmt::format("--set {}", printable(setting));
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) refuse(place, "expected key=value");
  const std::string key = setting.substr(0, equals);
  const Parameter* parameter = parameters.find(key);
  if (parameter == nullptr) refuse(place, unknown_key(parameters, key));
  const std::string text = setting.substr(equals + 1);
  check_nesting(text, place);
  assign(*parameter, setting_value(*parameter, text, place), place);
}

}  // namespace

Config resolve_config(const std::optional<std::filesystem::path>& file,
                      std::span<const std::string> settings) {
  Config config;
  const ParameterTable parameters = declare_parameters(config);
  if (file) read_toml(parameters, read_text(*file), printable(file->string()));
  for (const std::string& setting : settings) apply_setting(parameters, setting);
  derive_capacities(config);
  check_config(config);
  return config;
}

Config resolve_config_over(const BaseConfig& base, const std::optional<std::filesystem::path>& file,
                           std::span<const std::string> settings) {
  Config config;
  const ParameterTable parameters = declare_parameters(config);
  read_toml(parameters, base.toml, printable(base.place));
  if (file) read_toml(parameters, read_text(*file), printable(file->string()));
  for (const std::string& setting : settings) apply_setting(parameters, setting);
  derive_capacities(config);
  check_config(config);
  return config;
}

}  // namespace sheaf
