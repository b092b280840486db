// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/load_gltf.h"

namespace sheaf {

/// What the scene holds and needs, as `sheaf info` prints it: lines of "name  value", warnings
/// last.
[[nodiscard]] std::string scene_info(const LoadedScene& loaded);

}  // namespace sheaf
