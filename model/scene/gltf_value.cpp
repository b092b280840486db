// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_value.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/gltf_refusal.h"

namespace sheaf::gltf {
namespace {

const tinygltf::Value* find_member(const tinygltf::Value& object, const char* key) {
  return object.Has(key) ? &object.Get(key) : nullptr;
}

double as_number(const tinygltf::Value& value, const std::string& place) {
  if (!value.IsNumber()) refuse(place, "is not a number");
  return value.GetNumberAsDouble();
}

}  // namespace

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions,
                                      const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

double number_or(const tinygltf::Value& object, const char* key, double fallback,
                 const std::string& place) {
  const tinygltf::Value* value = find_member(object, key);
  return value ? as_number(*value, fmt::format("{}/{}", place, key)) : fallback;
}

int index_or_none(const tinygltf::Value& object, const char* key, const std::string& place) {
  const tinygltf::Value* value = find_member(object, key);
  if (!value) return -1;
  if (!value->IsInt()) refuse(fmt::format("{}/{}", place, key), "is not a valid index");
  return value->GetNumberAsInt();
}

Vec2 vec2_or(const tinygltf::Value& object, const char* key, Vec2 fallback,
             const std::string& place) {
  const tinygltf::Value* value = find_member(object, key);
  if (!value) return fallback;
  const std::string own = fmt::format("{}/{}", place, key);
  if (!value->IsArray() || value->ArrayLen() != 2) refuse(own, "is not an array of 2 numbers");
  return {checked_float(as_number(value->Get(0), own), own),
          checked_float(as_number(value->Get(1), own), own)};
}

Vec3 vec3_or(const std::vector<double>& numbers, Vec3 fallback, const std::string& place) {
  if (numbers.empty()) return fallback;
  if (numbers.size() != 3) refuse(place, fmt::format("has {} numbers, not 3", numbers.size()));
  return {checked_float(numbers[0], place), checked_float(numbers[1], place),
          checked_float(numbers[2], place)};
}

float checked_float(double number, const std::string& place) {
  const auto result = static_cast<float>(number);
  if (!std::isfinite(result)) {
    refuse(place, fmt::format("{} does not fit single precision", number));
  }
  return result;
}

}  // namespace sheaf::gltf
