// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geometry/ray.h"
#include "scene/scene.h"

namespace sheaf {

/// The ray through the centre of a pixel (row 0 is the top), of weight 1 and unit direction.
/// The picture's aspect ratio is width / height; the camera's vertical field of view holds.
[[nodiscard]] Ray primary_ray(const Camera& camera, std::uint32_t width, std::uint32_t height,
                              std::uint32_t x, std::uint32_t y);

}  // namespace sheaf
