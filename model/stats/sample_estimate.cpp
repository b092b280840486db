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

/// A product of sums over the sample, of whole powers 1 and -1, and of known factors.
class Product {
 public:
  void add(const SampledTotal& total, bool divides) {
    terms_.push_back({total.measured, divides});
    terms_.push_back({total.rough, !divides});
    known_ *= divides ? 1.0 / total.rough_total : total.rough_total;
  }

  [[nodiscard]] Estimate estimate(std::size_t population) const {
    const std::size_t sample = terms_.front().values.size();
    const double value = without(sample);
    const bool complete = sample == population;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(value) || (sample < 2 && !complete)) return {nan, nan, nan};
    const double half = complete ? 0.0 : half_width(population);
    return {value, value - half, value + half};
  }

 private:
  struct Term {
    std::span<const double> values;
    bool divides = false;
  };
  // The product with one unit of the sample left out; none if its number is that of the sample's
  // size.
  [[nodiscard]] double without(std::size_t unit) const {
    double product = known_;
    for (const Term& term : terms_) {
      const auto& values = term.values;
      double sum = std::accumulate(values.begin(), values.end(), 0.0);
      if (unit < values.size()) sum -= values[unit];
      product = term.divides ? product / sum : product * sum;
    }
    return product;
  }
  [[nodiscard]] double half_width(std::size_t population) const {
    const std::size_t sample = terms_.front().values.size();
    const auto n = static_cast<double>(sample);
    std::vector<double> products;
    for (std::size_t unit = 0; unit < sample; ++unit) products.push_back(without(unit));
    const double mean = std::accumulate(products.begin(), products.end(), 0.0) / n;
    double squares = 0;
    for (const double product : products) squares += (product - mean) * (product - mean);
    const double correction = 1.0 - n / static_cast<double>(population);
    return student_t_95(sample - 1) * std::sqrt(squares * (n - 1) / n * correction);
  }

  std::vector<Term> terms_;
  double known_ = 1;
};

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
  Product product;
  product.add(total, false);
  return product.estimate(population);
}

Estimate estimate_ratio(const SampledTotal& numerator, const SampledTotal& denominator,
                        std::size_t population) {
  Product product;
  product.add(numerator, false);
  product.add(denominator, true);
  return product.estimate(population);
}

}  // namespace sheaf
