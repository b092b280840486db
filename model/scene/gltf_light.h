// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace sheaf::gltf {

/// The lights of KHR_lights_punctual that nodes place. Lights without any intensity are dropped.
[[nodiscard]] std::vector<Light> read_lights(Document& document, const PlacedNodes& placed);

}  // namespace sheaf::gltf
