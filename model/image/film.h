// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "base/units.h"
#include "config/config.h"
#include "geometry/vec.h"

namespace sheaf {

/// Frame buffer into which weighted contributions are accumulated in one number format:
///   unorm8   each sum clamped to [0, 1] and rounded to 8 bits after every contribution
///   half     rounded to IEEE binary16 after every contribution (saturating at 65504)
///   float    rounded to IEEE binary32 after every contribution (saturating at FLT_MAX)
///   exact    no rounding until read: the result does not depend on the order of contributions
/// Contributions are finite and not negative; anything else is a bug, which add() refuses with
/// std::logic_error, as it does a pixel outside the film.
class Film {
 public:
  virtual ~Film() = default;
  virtual void add(std::uint32_t pixel, const Vec3& contribution) = 0;
  /// The pixel's sum, rounded once to float (exact) or as stored.
  [[nodiscard]] virtual Vec3 value(std::uint32_t pixel) const = 0;
  /// Bytes of simulated memory that one pixel takes in this format, a power of two.
  [[nodiscard]] virtual Bytes bytes_per_pixel() const = 0;
};

[[nodiscard]] std::unique_ptr<Film> make_film(FilmFormat format, std::uint32_t num_pixels);

}  // namespace sheaf
