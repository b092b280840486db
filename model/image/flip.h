// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "geometry/vec.h"

namespace sheaf {

/// The observer that LDR-FLIP assumes if nothing else is said: 0.7 m before a screen 0.7 m wide of
/// 3840 pixels.
inline constexpr double kFlipPixelsPerDegree = 0.7 * 3840.0 / 0.7 * 3.14159265358979323846 / 180.0;

/// Mean LDR-FLIP of two pictures of linear RGB, row by row, clamped to [0, 1]: what somebody who
/// switches between them would notice, 0 (nothing) to 1. After P. Andersson, J. Nilsson,
/// T. Akenine-Möller, M. Oskarsson, K. Åström and M. D. Fairchild, "FLIP: A Difference Evaluator
/// for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020, from where all
/// constants are. Throws std::logic_error if a picture has not width × height pixels or none.
[[nodiscard]] double ldr_flip(std::span<const Vec3> image, std::span<const Vec3> reference,
                              std::uint32_t width, std::uint32_t height,
                              double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace sheaf
