// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/tile_sample.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"

namespace sheaf {

TileSample::TileSample(std::uint32_t num_tiles, double share, std::uint64_t seed,
                       std::uint32_t warm_up)
    : num_tiles_(num_tiles), is_drawn_(num_stretches(), false) {
  const double wanted = std::ceil(share * num_stretches());
  const auto size =
      std::min(num_stretches(), std::max(kFewest, static_cast<std::uint32_t>(wanted)));
  // The first part of Fisher and Yates' shuffle.
  std::vector<std::uint32_t> others(num_stretches() - 1);
  std::iota(others.begin(), others.end(), 0U);
  Random random(seed);
  for (std::uint32_t i = 0; i + 1 < size; ++i) {
    const auto other = i + static_cast<std::uint32_t>(random.below(others.size() - i));
    std::swap(others[i], others[other]);
    drawn_.push_back(others[i]);
  }
  std::ranges::sort(drawn_);
  drawn_.push_back(num_stretches() - 1);
  for (const std::uint32_t stretch : drawn_) is_drawn_[stretch] = true;
  list_visits(warm_up);
}

void TileSample::list_visits(std::uint32_t warm_up) {
  std::uint32_t next = 0;  // first tile not listed yet
  const auto list = [&](std::uint32_t begin, std::uint32_t end) {
    for (next = std::max(next, begin); next < std::min(end, num_tiles_); ++next) {
      visits_.push_back(next);
    }
  };
  for (const std::uint32_t stretch : drawn_) {
    const std::uint32_t first = stretch * kStretch;
    list(first - std::min(first, warm_up), first + kStretch);
  }
}

}  // namespace sheaf
