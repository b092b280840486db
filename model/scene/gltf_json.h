// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace sheaf::gltf {

/// Parses a glTF file's JSON and checks what tinygltf leaves unchecked: nesting, version, required
/// extensions, and that every index is a whole number that fits tinygltf's 32 bits. Extras and
/// extensions that this loader does not know are dropped.
[[nodiscard]] nlohmann::json parse_gltf_json(std::string_view text);

}  // namespace sheaf::gltf
