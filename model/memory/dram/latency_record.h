// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "base/units.h"

namespace sheaf {

/// Latencies with their exact distribution: counts a value, of which there are few different ones
/// even in a long run.
class LatencyRecord {
 public:
  void record(Cycles latency) {
    ++num_;
    sum_ += latency;
    if (latency > max_) max_ = latency;
    if (latency < kDense) {
      if (latency >= dense_.size()) dense_.resize(latency + 1);
      ++dense_[latency];
    } else {
      ++sparse_[latency];
    }
  }

  [[nodiscard]] std::uint64_t num() const { return num_; }
  [[nodiscard]] std::uint64_t sum() const { return sum_; }
  [[nodiscard]] Cycles max() const { return max_; }
  /// The least value that at least `percent` of all values do not exceed; 0 if there are none.
  [[nodiscard]] Cycles percentile(double percent) const {
    const double wanted = percent / 100 * static_cast<double>(num_);
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < dense_.size(); ++i) {
      seen += dense_[i];
      if (seen != 0 && static_cast<double>(seen) >= wanted) return i;
    }
    for (const auto& [latency, count] : sparse_) {
      seen += count;
      if (static_cast<double>(seen) >= wanted) return latency;
    }
    return max_;
  }

 private:
  static constexpr Cycles kDense = 1 << 16;
  std::uint64_t num_ = 0, sum_ = 0;
  Cycles max_ = 0;
  std::vector<std::uint64_t> dense_;
  std::map<Cycles, std::uint64_t> sparse_;
};

}  // namespace sheaf
