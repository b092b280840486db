// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "config/config_text.h"
#include "config/parameters.h"

namespace sheaf {
namespace {

using Json = nlohmann::ordered_json;

/// Whole numbers without a decimal point.
Json number(double value) {
  constexpr double kExact = 0x1p53;
  if (std::trunc(value) == value && std::abs(value) <= kExact) {
    return static_cast<std::int64_t>(value);
  }
  return value;
}

Json range(const char* type, const Parameter& parameter) {
  return {{"type", type},
          {"minimum", number(parameter.lowest)},
          {"maximum", number(parameter.highest)}};
}

/// Values that are a number or a text with a unit; the range of the text is for the reader to
/// check.
Json quantity(const Json& plain, const char* pattern) {
  return {{"anyOf", {plain, {{"type", "string"}, {"pattern", pattern}}}}};
}

Json value_schema(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::kChoice:
      return {{"enum", parameter.choices}};
    case ParameterType::kCount:
      return range("integer", parameter);
    case ParameterType::kFlag:
      return {{"type", "boolean"}};
    case ParameterType::kText:
      return {{"type", "string"}};
    case ParameterType::kReal:
      return range("number", parameter);
    case ParameterType::kTriple:
      return {{"type", "array"},
              {"items", range("number", parameter)},
              {"minItems", 3},
              {"maxItems", 3}};
    case ParameterType::kBytes:
      return quantity(range("integer", parameter), "^[0-9]+ ?([KMGT]iB|B)?$");
    case ParameterType::kFrequency:
      return quantity(range("number", parameter),
                      "^[0-9]+(\\.[0-9]+)?([eE][+-]?[0-9]+)? ?([kMGT]?Hz)?$");
  }
  return {};
}

Json parameter_schema(const Parameter& parameter) {
  Json schema = value_schema(parameter);
  if (parameter.optional) schema = {{"anyOf", {schema, {{"const", "off"}}}}};
  schema["description"] = parameter.unit.empty() || parameter.unit == "1"
                              ? parameter.meaning
                              : parameter.meaning + " [" + parameter.unit + "]";
  // Default texts are TOML values; those of scalars, strings and arrays of numbers are JSON as
  // well.
  schema["default"] = Json::parse(parameter.default_text);
  return schema;
}

}  // namespace

std::string config_schema() {
  Config defaults;
  const ParameterTable table = declare_parameters(defaults);
  Json root = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
               {"title", "Configuration of a Sheaf run"},
               {"type", "object"},
               {"additionalProperties", false},
               {"properties", Json::object()}};
  for (const Parameter& parameter : table.parameters()) {
    Json* object = &root;
    std::string_view rest = parameter.key;
    for (auto dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
      Json& inner = (*object)["properties"][std::string(rest.substr(0, dot))];
      if (inner.is_null()) {
        inner = {
            {"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
      }
      object = &inner;
      rest.remove_prefix(dot + 1);
    }
    (*object)["properties"][std::string(rest)] = parameter_schema(parameter);
  }
  return root.dump(2) + "\n";
}

}  // namespace sheaf
