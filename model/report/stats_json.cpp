// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/stats_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace sheaf {
namespace {

using Json = nlohmann::json;

/// JSON text; bytes that are not UTF-8 (names from a scene file) become U+FFFD.
std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json to_json(const StatsValue& value) {
  return std::visit(
      [](const auto& v) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::monostate>) {
          return nullptr;
        } else {
          return v;
        }
      },
      value);
}

}  // namespace

std::string stats_json(const StatsTree& tree) {
  std::string out = "{";
  std::string_view separator = "\n";
  for (const StatsEntry& entry : tree.entries()) {
    out += fmt::format(R"({}  {}: {{"value": {}, "unit": {}}})", separator, dump(entry.path),
                       dump(to_json(entry.value)), dump(entry.unit));
    separator = ",\n";
  }
  return out + "\n}\n";
}

}  // namespace sheaf
