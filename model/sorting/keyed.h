// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sorting/heuristic.h"

namespace sheaf {

/// Base of the heuristics that give each ray one of a fixed number of keys: an associative store
/// of key → open cell.
class KeyedHeuristic : public Heuristic {
 public:
  KeyedHeuristic(std::uint32_t num_keys, std::uint32_t num_cells)
      : cell_of_key_(num_keys, kNoCell), key_of_cell_(num_cells, 0) {}

  [[nodiscard]] virtual std::uint32_t key(const Vec3& origin, const Vec3& direction) const = 0;

  [[nodiscard]] std::uint32_t find(const Vec3& origin, const Vec3& direction) const final {
    return cell_of_key_[key(origin, direction)];
  }
  void open(std::uint32_t cell, const Vec3& origin, const Vec3& direction) final {
    const std::uint32_t k = key(origin, direction);
    cell_of_key_[k] = cell;
    key_of_cell_[cell] = k;
  }
  void close(std::uint32_t cell) final { cell_of_key_[key_of_cell_[cell]] = kNoCell; }

 private:
  std::vector<std::uint32_t> cell_of_key_;
  std::vector<std::uint32_t> key_of_cell_;
};

}  // namespace sheaf
