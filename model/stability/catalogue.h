// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sheaf::stability {

/// How much of everything to try: all of it, or a share that takes seconds.
struct Effort {
  bool quick = false;
  /// `full` trials, or a twentieth of them, but at least one.
  [[nodiscard]] int trials(int full) const { return quick ? (full + 19) / 20 : full; }
};

/// What an error may be at most, and why no more: a derivation or a source.
struct Bound {
  double value = 0.0;
  std::string why;
};

/// One thing that was measured in a case.
struct Finding {
  std::string measured;      ///< what `error` is, with its unit
  std::uint64_t trials = 0;  ///< rays, sums, machines … that it is the worst or the sum of
  double error = 0.0;
  Bound bound;
  std::string worst;  ///< where the error is largest or, of errors counted, the first; may be empty

  /// False for NaN, and for a finding of no trials.
  [[nodiscard]] bool passes() const { return trials > 0 && error <= bound.value; }
};

/// One extreme or stiff case, which measures itself. The same effort gives the same findings.
struct StabilityCase {
  std::string group;    ///< rays, leaks, secondary, light, sums, machines, input or precision
  std::string name;     ///< unique
  std::string extreme;  ///< what is extreme about it
  std::function<std::vector<Finding>(const Effort&)> measure;
};

/// All cases, in the order of the report.
[[nodiscard]] std::vector<StabilityCase> catalogue();

// One function a group; catalogue() puts them together.
[[nodiscard]] std::vector<StabilityCase> ray_cases();
[[nodiscard]] std::vector<StabilityCase> leak_cases();
[[nodiscard]] std::vector<StabilityCase> secondary_cases();
[[nodiscard]] std::vector<StabilityCase> light_cases();
[[nodiscard]] std::vector<StabilityCase> sum_cases();
[[nodiscard]] std::vector<StabilityCase> machine_cases();
[[nodiscard]] std::vector<StabilityCase> input_cases();
[[nodiscard]] std::vector<StabilityCase> precision_cases();

/// γ(n) = n u / (1 - n u) for floats, u = 2^-24: how far n roundings can take a product or a sum
/// relatively (Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., lemma 3.1).
[[nodiscard]] constexpr double gamma(double n) {
  return n * 0x1p-24 / (1.0 - n * 0x1p-24);
}

/// Counts what goes wrong and remembers where it did first.
class Failures {
 public:
  void check(bool right, const std::function<std::string()>& where) {
    ++trials_;
    if (!right && count_++ == 0) first_ = where();
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] Finding finding(std::string measured, std::string why) const {
    return {
        std::move(measured), trials_, static_cast<double>(count_), {0.0, std::move(why)}, first_};
  }

 private:
  std::uint64_t trials_ = 0, count_ = 0;
  std::string first_;
};

/// The largest of some errors and where it was; NaN counts as larger than any number.
class Largest {
 public:
  void add(double error, const std::function<std::string()>& where) {
    ++trials_;
    if (error <= error_ || error_ != error_) return;
    error_ = error;
    where_ = where();
  }
  [[nodiscard]] Finding finding(std::string measured, Bound bound) const {
    return {std::move(measured), trials_, error_, std::move(bound), where_};
  }

 private:
  std::uint64_t trials_ = 0;
  double error_ = 0.0;
  std::string where_;
};

}  // namespace sheaf::stability
