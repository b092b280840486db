// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace sheaf::gltf {

struct NamedCamera {
  std::string name;      ///< of its node or, if that has none, its own
  std::string own_name;  ///< of the camera itself
  Camera camera;
};

/// The cameras that nodes place, in world space. Scale and shear of a node do not deform a camera.
[[nodiscard]] std::vector<NamedCamera> read_cameras(const Document& document,
                                                    const PlacedNodes& placed);

}  // namespace sheaf::gltf
