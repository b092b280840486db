// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "image/film.h"

namespace sheaf::stability {

/// The largest float, where sums saturate.
inline constexpr double kFloatMax = 0x1.fffffep127;

/// A film's format as rounding error analysis sees it. (The exact one rounds only when it is read.)
struct FilmRounding {
  FilmFormat format;
  const char* name;
  double relative;  ///< half an ulp of the sum
  double absolute;  ///< half the least step
  double largest;   ///< sums saturate here
};
inline constexpr std::array<FilmRounding, 3> kFilmRoundings = {
    {{FilmFormat::kUnorm8, "unorm8", 0.0, 1.0 / 510.0, 1.0},
     {FilmFormat::kHalf, "half", 0x1p-11, 0x1p-25, 65504.0},
     {FilmFormat::kFloat, "float", 0x1p-24, 0x1p-150, kFloatMax}}};

/// Of a film's `value` against a sum without rounding, or where that saturates.
[[nodiscard]] double relative_error(const FilmRounding& format, double value, double sum);

inline constexpr const char* kRunningErrorBound =
    "running error bound: the sum over all partial sums s of half an ulp of s (Higham 2002, "
    "section 4.3); no larger than the sum itself";
/// The largest relative_error() of the sum of `terms`, none of them negative, in this order.
[[nodiscard]] double relative_error_bound(const FilmRounding& format,
                                          const std::vector<float>& terms);

}  // namespace sheaf::stability
