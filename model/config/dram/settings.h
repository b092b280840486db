// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "base/units.h"
#include "config/dram/timing.h"

namespace sheaf {

/// What stands behind the L2: latency and bandwidth, or banks after one of the presets.
enum class DramModel : std::uint8_t {
  kFixed,
  kDdr4_2400,
  kDdr4_3200,
  kLpddr5_6400,
  kGddr6_14000,
  kHbm2_2000
};
enum class PagePolicy : std::uint8_t { kOpen, kClosed };

/// The parameters dram.*. Latency and bandwidth belong to the fixed model, the rest to the presets,
/// of which 0 (or an empty mapping) keeps the value.
struct DramSpec {
  DramModel model{};
  Cycles latency{};
  Bytes bytes_per_cycle{};

  std::uint32_t channels{}, ranks{};
  std::string mapping;
  PagePolicy page{};
  std::uint32_t read_queue{}, write_queue{};  ///< entries a channel
  std::uint32_t write_high{}, write_low{};    ///< entries at which a drain of writes begins, ends
  std::uint32_t row_hit_cap{};                ///< 0: none
  std::uint32_t controller_latency{};         ///< tCK
  bool refresh{};
  DramTiming timing;
};

}  // namespace sheaf
