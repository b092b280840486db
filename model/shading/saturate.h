// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "geometry/vec.h"

namespace sheaf {

/// A weight as a ray may carry it: FLT_MAX instead of infinity, 0 instead of NaN and negatives.
[[nodiscard]] inline float saturate(float x) {
  return x > 0.0F ? std::min(x, std::numeric_limits<float>::max()) : 0.0F;
}
[[nodiscard]] inline Vec3 saturate(const Vec3& v) {
  return {saturate(v.x), saturate(v.y), saturate(v.z)};
}

}  // namespace sheaf
