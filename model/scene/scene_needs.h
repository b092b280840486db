// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace sheaf {

/// What the scene needs, from the materials that its triangles use and its lights. Lights that
/// nothing diffuse can receive need no shadow rays.
[[nodiscard]] SceneNeeds make_needs(const Scene& scene);

}  // namespace sheaf
