// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/config.h"

namespace sheaf {

/// Sets the capacity of every cache whose sets are given.
void derive_capacities(Config& config);

/// Refuses combinations of values that no machine can have, each of them in range by itself: throws
/// Error(kUsage) with one line naming the keys and the rule that they break. The heuristic's text
/// is checked where heuristics are made.
void check_config(const Config& config);

/// The names listed in image.heat_maps, without spaces and empty entries. Throws Error(kUsage) for
/// an unknown or repeated name.
[[nodiscard]] std::vector<std::string> heat_map_names(const ImageSpec& image);

}  // namespace sheaf
