// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace sheaf {

/// Pseudo-LRU order of the ways of sets: a binary tree of bits a set, each of which points to the
/// half that was not used last (Al-Zoubi, Milenkovic and Milenkovic, "Performance evaluation of
/// cache replacement policies for the SPEC CPU2000 benchmark suite", ACM SE 2004).
class TreePlru {
 public:
  /// `ways`: a power of two up to 64.
  TreePlru(std::uint64_t sets, std::uint32_t ways) : ways_(ways), trees_(sets) {}

  void use(std::uint64_t set, std::uint32_t way) {
    std::uint64_t& tree = trees_[set];
    for (std::uint32_t node = way + ways_; node > 1; node /= 2) {
      const std::uint64_t bit = std::uint64_t{1} << (node / 2);
      tree = node % 2 == 0 ? tree | bit : tree & ~bit;
    }
  }
  [[nodiscard]] std::uint32_t victim(std::uint64_t set) const {
    std::uint32_t node = 1;
    while (node < ways_) node = 2 * node + static_cast<std::uint32_t>((trees_[set] >> node) & 1);
    return node - ways_;
  }

 private:
  std::uint32_t ways_;
  std::vector<std::uint64_t> trees_;  ///< bit i: node i, whose children are 2i and 2i + 1
};

}  // namespace sheaf
