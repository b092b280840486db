// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sorting/keyed.h"

namespace sheaf {

/// One key for all rays: packets fill in order of arrival.
class ArrivalHeuristic final : public KeyedHeuristic {
 public:
  explicit ArrivalHeuristic(std::uint32_t num_cells) : KeyedHeuristic(1, num_cells) {}
  [[nodiscard]] std::uint32_t key(const Vec3& /*origin*/,
                                  const Vec3& /*direction*/) const override {
    return 0;
  }
};

}  // namespace sheaf
