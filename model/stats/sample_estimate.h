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
  double certain = 0;                ///< measured beside it, of units that are never left out
};

/// The population's total: what is certain, and the rough total corrected by the ratio of measured
/// to rough in the sample (Cochran, Sampling Techniques, 3rd edition, 1977, chapter 6). The
/// interval is Student's t times the jackknife's standard error (B. Efron and C. Stein, "The
/// jackknife estimate of variance", Annals of Statistics 9(3), 1981), which for ratios of small
/// samples is less optimistic than the linearised one, with the finite population correction; none,
/// if the whole population is in the sample. All NaN if nothing can be divided by, or the sample
/// has fewer than two units out of more.
///
/// Student's degrees of freedom are those of the standard error (F. E. Satterthwaite, Biometrics
/// Bulletin 2(6), 1946): a variance of n values of excess kurtosis k scatters like one of
/// 2 / (2 / (n - 1) + k / n) degrees (Cramér, Mathematical Methods of Statistics, 1946, 27.4), no
/// more than n - 1, where a few units make up much of it. Rounded down; k as G2 of D. N. Joanes and
/// C. A. Gill, The Statistician 47(1), 1998.
[[nodiscard]] Estimate estimate_total(const SampledTotal& total, std::size_t population);

/// The same of the ratio of two totals, measured on the same units.
[[nodiscard]] Estimate estimate_ratio(const SampledTotal& numerator,
                                      const SampledTotal& denominator, std::size_t population);

}  // namespace sheaf
