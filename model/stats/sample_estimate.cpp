// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/sample_estimate.h"

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

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Collects the relative deviations of the terms whose product or quotient is estimated.
class Linearised {
 public:
  explicit Linearised(std::size_t sample) : deviation_(sample, 0.0) {}

  void add(std::span<const double> values, double sign) {
    const double centre = mean(values);
    for (std::size_t i = 0; i < values.size(); ++i) deviation_[i] += sign * values[i] / centre;
    factor_ *= sign > 0 ? centre : 1.0 / centre;
  }
  void scale(double by) { factor_ *= by; }

  [[nodiscard]] Estimate estimate(std::size_t population) const {
    const std::size_t sample = deviation_.size();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const bool complete = sample == population;
    if (!std::isfinite(factor_) || (sample < 2 && !complete)) return {nan, nan, nan};
    const double half = complete ? 0.0 : std::fabs(factor_) * half_width(population);
    return {factor_, factor_ - half, factor_ + half};
  }

 private:
  [[nodiscard]] double half_width(std::size_t population) const {
    const auto n = static_cast<double>(deviation_.size());
    const double centre = mean(deviation_);
    double squares = 0;
    for (const double d : deviation_) squares += (d - centre) * (d - centre);
    const double variance = squares / (n - 1) / n * (1 - n / static_cast<double>(population));
    return student_t_95(deviation_.size() - 1) * std::sqrt(variance);
  }

  std::vector<double> deviation_;
  double factor_ = 1;
};

void add_total(Linearised& linear, const SampledTotal& total, double sign) {
  linear.add(total.measured, sign);
  linear.add(total.rough, -sign);
  linear.scale(sign > 0 ? total.rough_total : 1.0 / total.rough_total);
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
  Linearised linear(total.measured.size());
  add_total(linear, total, 1);
  return linear.estimate(population);
}

Estimate estimate_ratio(const SampledTotal& numerator, const SampledTotal& denominator,
                        std::size_t population) {
  Linearised linear(numerator.measured.size());
  add_total(linear, numerator, 1);
  add_total(linear, denominator, -1);
  return linear.estimate(population);
}

}  // namespace sheaf
