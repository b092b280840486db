// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/config_text.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>

#include "base/text.h"
#include "config/parameters.h"

namespace sheaf {
namespace {

struct Group {
  std::string name;  ///< what stands before the key's last dot: the TOML table
  std::vector<const Parameter*> members;
};

/// Parameters by TOML table, in the order in which the tables first appear.
std::vector<Group> groups_of(const ParameterTable& table) {
  std::vector<Group> groups;
  for (const Parameter& parameter : table.parameters()) {
    const std::string name = parameter.key.substr(0, parameter.key.rfind('.'));
    auto it = std::ranges::find(groups, name, &Group::name);
    if (it == groups.end()) it = groups.insert(it, {name, {}});
    it->members.push_back(&parameter);
  }
  return groups;
}

}  // namespace

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string config_toml(const Config& config, Comments comments) {
  Config bound;
  const ParameterTable table = declare_parameters(bound);
  bound = config;
  std::string out;
  for (const Group& group : groups_of(table)) {
    out += fmt::format("{}[{}]\n", out.empty() ? "" : "\n", group.name);
    for (const Parameter* parameter : group.members) {
      if (comments == Comments::kMeanings) {
        const std::string range = parameter->range_text();
        out += wrapped(
            fmt::format("{}{}{}.", parameter->meaning, range.empty() ? "" : ". Range: ", range),
            "# ");
      }
      out += fmt::format("{} = {}\n", parameter->key.substr(group.name.size() + 1),
                         parameter->current());
    }
  }
  return out;
}

std::string config_hash(const Config& config) {
  const std::string text = config_toml(config, Comments::kNone);
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::vector<std::string> changed_keys(const Config& a, const Config& b) {
  Config bound_a;
  Config bound_b;
  const ParameterTable table_a = declare_parameters(bound_a);
  const ParameterTable table_b = declare_parameters(bound_b);
  bound_a = a;
  bound_b = b;
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < table_a.parameters().size(); ++i) {
    const Parameter& parameter = table_a.parameters()[i];
    if (parameter.current() != table_b.parameters()[i].current()) keys.push_back(parameter.key);
  }
  return keys;
}

std::string describe_parameters() {
  Config defaults;
  const ParameterTable table = declare_parameters(defaults);
  std::string out;
  for (const Group& group : groups_of(table)) {
    out += fmt::format("{}[{}]\n", out.empty() ? "" : "\n", group.name);
    for (const Parameter* parameter : group.members) {
      const std::string range = parameter->range_text();
      out += fmt::format("  {} = {}{}{}\n", parameter->key, parameter->default_text,
                         range.empty() ? "" : "    # ", range);
      out += wrapped(parameter->meaning, "      ");
    }
  }
  return out;
}

}  // namespace sheaf
