// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace sheaf {

/// Gives every vertex from `first_vertex` on whose normal is exactly zero the normal of the
/// triangles at it from `first_triangle` on, weighted by area: a flat normal where a vertex
/// belongs to one triangle. A vertex at degenerate triangles only gets +y.
void fill_missing_normals(Scene& scene, std::size_t first_vertex, std::size_t first_triangle);

}  // namespace sheaf
