// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/config.h"
#include "system/prepared_scene.h"

namespace sheaf {

/// How far a picture is from the double-precision reference.
struct ImageError {
  std::string picture;  ///< what was rendered
  std::string film;     ///< in which number format
  double cycles = 0;    ///< of the frame, timed; NaN: nothing was simulated
  double rmse = 0;
  double rel_mse = 0;  ///< see compare_images()
  double flip = 0;     ///< mean LDR-FLIP
};

/// The scene as the machine renders it with each film format, at fidelity timed, against
/// ReferenceTracer, which computes everything in double; and the paper's example: 1000
/// contributions of 0.001 to one pixel, which should become 1 (Månsson, Munkberg and Akenine-Möller
/// 2007, on why weighted rays need a high-precision frame buffer). `config`'s own format is left
/// aside. Empty if `stop` ended it.
[[nodiscard]] std::vector<ImageError> image_errors(const Config& config, PreparedScene& scene,
                                                   const std::function<bool()>& stop);

}  // namespace sheaf
