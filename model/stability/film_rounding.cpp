// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/film_rounding.h"

#include <algorithm>
#include <cmath>

#include "stability/exact.h"

namespace sheaf::stability {

double relative_error(const FilmRounding& format, double value, double sum) {
  const double right = std::min(sum, format.largest);
  return std::abs(value - right) / right;
}

double relative_error_bound(const FilmRounding& format, const std::vector<float>& terms) {
  const auto film = make_film(format.format, 1);
  double bound = 0.0;
  for (const float term : terms) {
    film->add(0, Vec3(term));
    bound += format.relative * double{film->value(0).x} + format.absolute;
  }
  return std::min(bound / std::min(sum_exactly(terms), format.largest), 1.0);
}

}  // namespace sheaf::stability
