// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace sheaf {

/// An estimate with its 95 % confidence interval.
struct Estimate {
  double value = 0;
  double low = 0;
  double high = 0;
};

/// The t that Student's distribution of `degrees` (at least 1) stays within, ±t, with probability
/// 0.95. From the closed form of its integral for whole degrees (Abramowitz and Stegun, Handbook of
/// Mathematical Functions, 26.7.3 and 26.7.4).
[[nodiscard]] double student_t_95(std::size_t degrees);

/// One quantity of the units of a population, of which all are known roughly and a simple random
/// sample, drawn without replacement, is known well.
struct SampledTotal {
  std::span<const double> measured;  ///< of the sample
  std::span<const double> rough;     ///< of the same units, in the same order
  double rough_total = 0;            ///< over the whole population
};

/// The population's total: the rough total, corrected by the ratio of measured to rough in the
/// sample. The interval is that of the linearised ratio estimator with the finite population
/// correction (Cochran, Sampling Techniques, 3rd edition, 1977, sections 6.3 and 6.4) and Student's
/// t with one degree less than there are units in the sample; none, if the whole population is in
/// it. All NaN if a mean is 0 or the sample has fewer than two units out of more.
[[nodiscard]] Estimate estimate_total(const SampledTotal& total, std::size_t population);

/// The same of the ratio of two totals, measured on the same units.
[[nodiscard]] Estimate estimate_ratio(const SampledTotal& numerator,
                                      const SampledTotal& denominator, std::size_t population);

}  // namespace sheaf
