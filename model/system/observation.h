// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stats/counters.h"

namespace sheaf {

/// What the fidelities that do not simulate a whole frame in time are judged by. Each is a total,
/// or a ratio of two.
enum class Observed : std::uint8_t {
  kCycles,
  kDramBytes,
  kNodeHits,
  kNodeAccesses,
  kTriangleHits,
  kTriangleAccesses,
  kAttributeHits,
  kAttributeAccesses,
  kTextureHits,
  kTextureAccesses,
  kFilmHits,
  kFilmAccesses,
  kL2Hits,
  kL2Accesses,
  kRayCacheHits,
  kRayCacheInsertions,
  kPrimaryRayVisits,
  kPrimaryPacketVisits,
  kSecondaryRayVisits,
  kSecondaryPacketVisits,
  kNone
};
inline constexpr auto kNumObserved = static_cast<std::size_t>(Observed::kNone);

/// Running totals of a machine, units of the same kind taken together.
class Observation {
 public:
  [[nodiscard]] std::uint64_t& operator[](Observed what) {
    return totals_[static_cast<std::size_t>(what)];
  }
  [[nodiscard]] std::uint64_t operator[](Observed what) const {
    return totals_[static_cast<std::size_t>(what)];
  }
  Observation& operator+=(const Observation& other) {
    for (std::size_t i = 0; i < kNumObserved; ++i) totals_[i] += other.totals_[i];
    return *this;
  }
  /// What has come since `earlier`.
  [[nodiscard]] Observation since(const Observation& earlier) const {
    Observation difference;
    for (std::size_t i = 0; i < kNumObserved; ++i) {
      difference.totals_[i] = totals_[i] - earlier.totals_[i];
    }
    return difference;
  }

 private:
  std::array<std::uint64_t, kNumObserved> totals_{};
};

/// A quantity that is reported as an estimate, and compared between fidelities.
struct Quantity {
  CounterInfo info;
  Observed total{};
  Observed per = Observed::kNone;  ///< kNone: the total itself
};

/// Every such quantity, beginning with these two.
[[nodiscard]] std::span<const Quantity> observed_quantities();
inline constexpr std::size_t kCyclesQuantity = 0;
inline constexpr std::size_t kDramBytesQuantity = 1;

}  // namespace sheaf
