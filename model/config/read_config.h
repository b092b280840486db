// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "config/config.h"

namespace sheaf {

/// The defaults, overridden by a TOML file, overridden by `key=value` settings, the later one
/// winning. A setting's value is a TOML value; what is none is taken as text, so that quotes may be
/// left out
/// ("ray_cache.heuristic=dir", "l2.capacity=4MiB", "camera.position=[1,2,3]").
///
/// Throws Error(kUsage) with one line that names the place (file:line, or the setting) for a file
/// that cannot be read, is larger than 1 MiB or is not TOML, an unknown key (with the nearest known
/// one), a value of the wrong type, out of range, not finite or in an unknown unit, and whatever
/// check_config refuses.
[[nodiscard]] Config resolve_config(const std::optional<std::filesystem::path>& file,
                                    std::span<const std::string> settings);

/// A configuration in TOML that stands somewhere else than in a file of its own.
struct BaseConfig {
  std::string toml;
  std::string place;  ///< for messages
};

/// The same with `base` between the defaults and the file.
[[nodiscard]] Config resolve_config_over(const BaseConfig& base,
                                         const std::optional<std::filesystem::path>& file,
                                         std::span<const std::string> settings);

}  // namespace sheaf
