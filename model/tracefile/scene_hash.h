// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"
#include "tracefile/container.h"

namespace sheaf {

/// XXH3 (128 bits) of everything in a scene that rays and shading depend on, as it was loaded:
/// geometry, materials, textures, lights, camera and background. Names do not count.
[[nodiscard]] Hash128 scene_hash(const Scene& scene);

}  // namespace sheaf
