// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>

#include "geometry/vec.h"

namespace sheaf {

/// Added to the squared reference in rel_mse, so that black pixels do not decide it alone.
inline constexpr double kRelMseFloor = 0.01;

/// How far an image is from a reference; all three over every channel of every pixel.
struct ImageDifference {
  double rmse = 0.0;            ///< sqrt(mean((x - r)²))
  double rel_mse = 0.0;         ///< mean((x - r)² / (r² + kRelMseFloor))
  double max_abs = 0.0;         ///< max |x - r|
  std::size_t worst_pixel = 0;  ///< the first pixel with max_abs
};

/// Compares two linear RGB images. Throws std::logic_error if they differ in size or are empty. A
/// NaN in either makes every figure NaN.
[[nodiscard]] inline ImageDifference compare_images(std::span<const Vec3> image,
                                                    std::span<const Vec3> reference) {
  if (image.size() != reference.size() || image.empty()) {
    throw std::logic_error("compare_images: the images are empty or differ in size");
  }
  ImageDifference result;
  double squares = 0.0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Vec3d r(reference[i]);
    const Vec3d d = Vec3d(image[i]) - r;
    for (int channel = 0; channel < 3; ++channel) {
      const double square = d[channel] * d[channel];
      squares += square;
      result.rel_mse += square / (r[channel] * r[channel] + kRelMseFloor);
      const double distance = std::fabs(d[channel]);
      if (!(distance <= result.max_abs) && !std::isnan(result.max_abs)) {
        result.max_abs = distance;
        result.worst_pixel = i;
      }
    }
  }
  const double count = 3.0 * static_cast<double>(image.size());
  result.rmse = std::sqrt(squares / count);
  result.rel_mse /= count;
  return result;
}

}  // namespace sheaf
