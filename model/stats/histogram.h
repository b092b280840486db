// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

#include "stats/counters.h"

namespace sheaf {

class StatsTree;

/// Count, sum, greatest value and bins of a quantity: one bin a value up to 64 (packet fills), or
/// one bin a power of two (residency times). Recording costs a few instructions.
template <typename Binning>
class Histogram {
 public:
  void record(std::uint64_t value) noexcept {
    ++num_;
    sum_ += value;
    max_ = std::max(max_, value);
    ++bins_[Binning::bin(value)];
  }

  [[nodiscard]] std::uint64_t num() const noexcept { return num_; }
  [[nodiscard]] std::uint64_t sum() const noexcept { return sum_; }
  [[nodiscard]] std::uint64_t max() const noexcept { return max_; }
  [[nodiscard]] std::uint64_t bin(std::size_t index) const noexcept { return bins_[index]; }

  Histogram& operator+=(const Histogram& other) noexcept {
    num_ += other.num_;
    sum_ += other.sum_;
    max_ = std::max(max_, other.max_);
    for (std::size_t i = 0; i < Binning::kNumBins; ++i) bins_[i] += other.bins_[i];
    return *this;
  }

 private:
  std::uint64_t num_ = 0, sum_ = 0, max_ = 0;
  std::array<std::uint64_t, Binning::kNumBins> bins_{};
};

/// Bin 0 holds 0; bin i holds [2^(i-1), 2^i).
struct PowerOfTwoBins {
  static constexpr std::size_t kNumBins = 65;
  static constexpr std::size_t bin(std::uint64_t value) noexcept {
    return static_cast<std::size_t>(std::bit_width(value));
  }
  /// The least value of a bin.
  static constexpr std::uint64_t lowest(std::size_t bin) noexcept {
    return bin == 0 ? 0 : std::uint64_t{1} << (bin - 1);
  }
};

/// Bin i holds i; the last one also what is above.
struct LinearBins {
  static constexpr std::size_t kNumBins = 65;
  static constexpr std::size_t bin(std::uint64_t value) noexcept {
    return std::min<std::size_t>(value, kNumBins - 1);
  }
  static constexpr std::uint64_t lowest(std::size_t bin) noexcept { return bin; }
};

using TimeHistogram = Histogram<PowerOfTwoBins>;
using FillHistogram = Histogram<LinearBins>;

/// Adds `path.num`, `.mean`, `.max` and one `.bin_<lowest value>` for each bin that is not empty.
/// `what` names the thing recorded ("packets"), `unit` the unit of its value ("cycles").
template <typename Binning>
void add_histogram(StatsTree& tree, std::string_view path, const Histogram<Binning>& histogram,
                   std::string_view what, std::string_view unit, std::string_view meaning);

/// What add_histogram() adds, for `sheaf counters`.
inline constexpr CounterInfo kHistogramInfos[] = {
    {"num", "", "How many"},
    {"mean", "", "Mean"},
    {"max", "", "Greatest"},
    {"bin_<n>", "", "How many from n up to the next bin; left out if none"}};

}  // namespace sheaf
