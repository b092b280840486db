// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/box.h"
#include "geometry/vec.h"
#include "scene/scene.h"

namespace sheaf {

/// Camera at `position` with orthonormal axes: forward as given (unit), right level with respect to
/// `up`, which may have any length and direction; where it is useless, another up is chosen. The
/// field of view is the default's.
[[nodiscard]] Camera look_along(const Vec3d& position, const Vec3d& forward, const Vec3d& up);

/// Camera at `position` that looks at `target` with y up; along -z if the two coincide.
[[nodiscard]] Camera look_at(const Vec3& position, const Vec3& target);

/// A three-quarter view of the box from above, just far enough for its bounding sphere to fit the
/// picture's height.
[[nodiscard]] Camera frame_box(const Box& box);

}  // namespace sheaf
