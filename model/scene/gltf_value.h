// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <string>
#include <vector>

#include "geometry/vec.h"

namespace sheaf::gltf {

/// Extension `name`, or null if the object does not have it.
[[nodiscard]] const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions,
                                                    const std::string& name);

/// Member `key` of an object as a number, whether the file wrote it as an integer or not.
/// `place` is the object's, for messages.
[[nodiscard]] double number_or(const tinygltf::Value& object, const char* key, double fallback,
                               const std::string& place);
/// Member `key` as an index; -1 if it is missing.
[[nodiscard]] int index_or_none(const tinygltf::Value& object, const char* key,
                                const std::string& place);
[[nodiscard]] Vec2 vec2_or(const tinygltf::Value& object, const char* key, Vec2 fallback,
                           const std::string& place);

/// Three numbers that fit a float; an empty array gives the fallback.
[[nodiscard]] Vec3 vec3_or(const std::vector<double>& numbers, Vec3 fallback,
                           const std::string& place);
/// A number that fits a float.
[[nodiscard]] float checked_float(double number, const std::string& place);

}  // namespace sheaf::gltf
