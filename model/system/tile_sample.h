// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "config/config.h"

namespace sheaf {

/// Which tiles of a frame are simulated in time: stretches of kStretch tiles that follow each
/// other, with those that prepare them. The last stretch always is, since the machine runs empty in
/// it and no other can stand for it; of the others a simple random sample, without replacement.
class TileSample {
 public:
  static constexpr std::uint32_t kStretch = 4;
  /// Stretches that are drawn at least, if there are so many: fewer say too little about how much
  /// they differ.
  static constexpr std::uint32_t kFewest = 16;

  /// `warm_up`: tiles before each stretch that are simulated and not counted, so that the machine
  /// is as full as it would be.
  TileSample(std::uint32_t num_tiles, double share, std::uint64_t seed, std::uint32_t warm_up);

  [[nodiscard]] std::uint32_t num_stretches() const {
    return (num_tiles_ + kStretch - 1) / kStretch;
  }
  /// In ascending order, the last stretch at the end.
  [[nodiscard]] const std::vector<std::uint32_t>& drawn() const { return drawn_; }
  [[nodiscard]] static std::uint32_t stretch_of(std::uint32_t tile) { return tile / kStretch; }
  [[nodiscard]] bool counts(std::uint32_t tile) const { return is_drawn_[stretch_of(tile)]; }

  /// All tiles that are simulated in time, in ascending order.
  [[nodiscard]] const std::vector<std::uint32_t>& visits() const { return visits_; }

 private:
  void list_visits(std::uint32_t warm_up);

  std::uint32_t num_tiles_;
  std::vector<bool> is_drawn_;
  std::vector<std::uint32_t> drawn_;
  std::vector<std::uint32_t> visits_;
};

}  // namespace sheaf
