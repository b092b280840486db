// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/sample_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace sheaf {
namespace {

// Probability of |T| < tan(theta) · sqrt(degrees).
double probability_within(double theta, std::size_t degrees) {
  const double sine = std::sin(theta);
  const double cosine = std::cos(theta);
  const bool odd = degrees % 2 != 0;
  double term = odd ? cosine : 1.0;
  double sum = degrees == 1 ? 0.0 : term;
  for (std::size_t k = odd ? 3 : 2; k < degrees; k += 2) {
    term *= cosine * cosine * static_cast<double>(k - 1) / static_cast<double>(k);
    sum += term;
  }
  return odd ? 2.0 / std::numbers::pi * (theta + sine * sum) : sine * sum;
}

/// The total without one unit of the sample; without none if its number is that of the sample's
/// size.
double total_without(std::size_t unit, const SampledTotal& total) {
  if (total.measured.empty()) return total.certain;
  const auto sum = [&](std::span<const double> values) {
    const double all = std::accumulate(values.begin(), values.end(), 0.0);
    return unit < values.size() ? all - values[unit] : all;
  };
  return total.certain + total.rough_total * sum(total.measured) / sum(total.rough);
}

/// The mean of (value - mean)^power.
double moment(std::span<const double> values, int power) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double sum = 0;
  for (const double value : values) sum += std::pow(value - mean, power);
  return sum / n;
}

std::size_t degrees_of_freedom(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  const double variance = moment(values, 2);
  if (values.size() < 4 || variance == 0) return values.size() - 1;
  const double excess = moment(values, 4) / (variance * variance) - 3;
  const double kurtosis = ((n + 1) * excess + 6) * (n - 1) / ((n - 2) * (n - 3));
  return static_cast<std::size_t>(2 / (2 / (n - 1) + std::max(kurtosis, 0.0) / n));
}

/// `without(unit)`: the estimate with that unit of the sample left out.
template <typename Without>
Estimate jackknife(std::size_t sample, std::size_t population, const Without& without) {
  const double value = without(sample);
  const bool complete = sample == population;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(value) || (sample < 2 && !complete)) return {nan, nan, nan};
  if (complete) return {value, value, value};
  const auto n = static_cast<double>(sample);
  std::vector<double> values;
  for (std::size_t unit = 0; unit < sample; ++unit) values.push_back(without(unit));
  const double correction = 1.0 - n / static_cast<double>(population);
  const double error = std::sqrt(moment(values, 2) * (n - 1) * correction);
  const double half = student_t_95(degrees_of_freedom(values)) * error;
  return {value, value - half, value + half};
}

}  // namespace

double student_t_95(std::size_t degrees) {
  double low = 0;
  double high = std::numbers::pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (probability_within(middle, degrees) < 0.95 ? low : high) = middle;
  }
  return std::tan(low) * std::sqrt(static_cast<double>(degrees));
}

Estimate estimate_total(const SampledTotal& total, std::size_t population) {
  return jackknife(total.measured.size(), population,
                   [&](std::size_t unit) { return total_without(unit, total); });
}

Estimate estimate_ratio(const SampledTotal& numerator, const SampledTotal& denominator,
                        std::size_t population) {
  return jackknife(numerator.measured.size(), population, [&](std::size_t unit) {
    return total_without(unit, numerator) / total_without(unit, denominator);
  });
}

}  // namespace sheaf
