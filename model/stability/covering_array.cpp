// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/covering_array.h"

#include <algorithm>
#include <numeric>

#include "base/random.h"

namespace sheaf::stability {
namespace {

using Row = std::vector<std::size_t>;

/// Which choices of levels of one set of factors have not occurred yet.
class FactorSet {
 public:
  FactorSet(Row factors, const std::vector<std::size_t>& levels) : factors_(std::move(factors)) {
    std::size_t combinations = 1;
    for (const std::size_t f : factors_) combinations *= levels[f];
    uncovered_.assign(combinations, true);
    for (const std::size_t f : factors_) levels_.push_back(levels[f]);
  }
  [[nodiscard]] const Row& factors() const { return factors_; }
  [[nodiscard]] bool is_new(const Row& row) const { return uncovered_[index(row)]; }
  /// Returns how many choices this covers for the first time.
  std::size_t cover(const Row& row) {
    const std::size_t i = index(row);
    const std::size_t gain = uncovered_[i] ? 1 : 0;
    uncovered_[i] = false;
    return gain;
  }
  [[nodiscard]] std::size_t size() const { return uncovered_.size(); }
  /// Puts the first choice that is uncovered into the row, if there is one.
  bool seed(Row& row) const {
    const auto found = std::ranges::find(uncovered_, true);
    if (found == uncovered_.end()) return false;
    auto i = static_cast<std::size_t>(found - uncovered_.begin());
    for (std::size_t k = factors_.size(); k-- > 0;) {
      row[factors_[k]] = i % levels_[k];
      i /= levels_[k];
    }
    return true;
  }

 private:
  [[nodiscard]] std::size_t index(const Row& row) const {
    std::size_t i = 0;
    for (std::size_t k = 0; k < factors_.size(); ++k) i = i * levels_[k] + row[factors_[k]];
    return i;
  }
  Row factors_, levels_;
  std::vector<bool> uncovered_;
};

/// All sets of `strength` factors of [first, count).
void add_sets(Row& chosen, std::size_t first, std::size_t strength,
              const std::vector<std::size_t>& levels, std::vector<FactorSet>& sets) {
  if (chosen.size() == strength) {
    sets.emplace_back(chosen, levels);
    return;
  }
  for (std::size_t f = first; f < levels.size(); ++f) {
    chosen.push_back(f);
    add_sets(chosen, f + 1, strength, levels, sets);
    chosen.pop_back();
  }
}

}  // namespace

std::vector<Row> covering_array(const std::vector<std::size_t>& levels, std::size_t strength) {
  constexpr int kCandidates = 30;
  std::vector<FactorSet> sets;
  Row chosen;
  add_sets(chosen, 0, strength, levels, sets);
  std::size_t left = 0;
  for (const FactorSet& set : sets) left += set.size();

  Random random(1);
  std::vector<Row> rows;
  while (left > 0) {
    // Random rows that cover at least one choice which none has covered, and the best of those.
    Row best;
    std::size_t most = 0;
    for (int candidate = 0; candidate < kCandidates; ++candidate) {
      Row row;
      for (const std::size_t count : levels) row.push_back(random.below(count));
      const std::size_t start = random.below(sets.size());
      for (std::size_t i = 0; i < sets.size(); ++i) {
        if (sets[(start + i) % sets.size()].seed(row)) break;
      }
      const auto gain = static_cast<std::size_t>(
          std::ranges::count_if(sets, [&](const FactorSet& set) { return set.is_new(row); }));
      if (gain > most) {
        most = gain;
        best = row;
      }
    }
    for (FactorSet& set : sets) left -= set.cover(best);
    rows.push_back(std::move(best));
  }
  return rows;
}

}  // namespace sheaf::stability
