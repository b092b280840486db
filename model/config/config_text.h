// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"

namespace sheaf {

/// `text` as a TOML basic string, with its quotes.
[[nodiscard]] std::string toml_string(std::string_view text);

/// Whether config_toml puts a comment with range and meaning above each key.
enum class Comments : bool { kNone, kMeanings };

/// Every parameter's value, by table and in the order of declaration. resolve_config reads the same
/// configuration back from it, and writes the same text again.
[[nodiscard]] std::string config_toml(const Config& config, Comments comments);

/// 32 hexadecimal digits (XXH3, 128 bits) of config_toml without comments: equal for two
/// configurations just when each parameter is.
[[nodiscard]] std::string config_hash(const Config& config);

/// The keys of the parameters in which two configurations differ, in the order of declaration.
[[nodiscard]] std::vector<std::string> changed_keys(const Config& a, const Config& b);

/// What `sheaf config` prints: key, default, range, unit and meaning of every parameter.
[[nodiscard]] std::string describe_parameters();

/// What `sheaf config --schema` prints: a JSON schema (draft 2020-12) of the configuration file,
/// for editors.
[[nodiscard]] std::string config_schema();

}  // namespace sheaf
