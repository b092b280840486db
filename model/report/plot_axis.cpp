// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/plot_axis.h"

#include <algorithm>
#include <cmath>

namespace sheaf {
namespace {

constexpr double kMaxTicks = 8;

// The least of 1, 2 and 5 times a power of ten that gives at most kMaxTicks steps over a length.
double nice_step(double length) {
  const double least = length / kMaxTicks;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) return factor * power;
  }
  return 10 * power;
}

}  // namespace

bool AxisRange::can_show(double value) const {
  return std::isfinite(value) && (scale_ == PlotScale::kLinear || value > 0);
}

double AxisRange::to_line(double value) const {
  switch (scale_) {
    case PlotScale::kLinear:
      return value;
    case PlotScale::kLog2:
      return std::log2(value);
    case PlotScale::kLog10:
      return std::log10(value);
  }
  return value;
}

double AxisRange::from_line(double position) const {
  switch (scale_) {
    case PlotScale::kLinear:
      return position;
    case PlotScale::kLog2:
      return std::exp2(position);
    case PlotScale::kLog10:
      return std::pow(10.0, position);
  }
  return position;
}

void AxisRange::include(double value) {
  const double position = to_line(value);
  low_ = empty_ ? position : std::min(low_, position);
  high_ = empty_ ? position : std::max(high_, position);
  empty_ = false;
}

// Logarithmic axes are labelled at whole powers.
double AxisRange::step() const {
  const double step = nice_step(high_ - low_);
  return scale_ == PlotScale::kLinear ? step : std::max(1.0, std::ceil(step));
}

void AxisRange::round() {
  if (!(high_ > low_)) {
    const double half = scale_ == PlotScale::kLinear && low_ != 0 ? std::abs(low_) / 2 : 0.5;
    low_ -= half;
    high_ += half;
  }
  const double step = this->step();
  low_ = std::floor(low_ / step + 1e-9) * step;
  high_ = std::ceil(high_ / step - 1e-9) * step;
}

double AxisRange::position(double value) const {
  return (to_line(value) - low_) / (high_ - low_);
}

std::vector<double> AxisRange::ticks() const {
  std::vector<double> ticks;
  const double step = this->step();
  // The step of a range that round() has widened may be a longer one.
  const auto first = static_cast<long long>(std::ceil(low_ / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(high_ / step + 1e-9));
  for (long long i = first; i <= last; ++i)
    ticks.push_back(from_line(static_cast<double>(i) * step));
  return ticks;
}

}  // namespace sheaf
