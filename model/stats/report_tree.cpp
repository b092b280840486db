// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/report_tree.h"

#include <cmath>
#include <stdexcept>

namespace sheaf {

void StatsTree::add_entry(StatsEntry entry) {
  if (!index_.try_emplace(entry.path, entries_.size()).second) {
    throw std::logic_error("reported twice: " + entry.path);
  }
  entries_.push_back(std::move(entry));
}

void StatsTree::add(std::string path, std::uint64_t value, std::string_view unit,
                    std::string_view meaning) {
  add_entry({std::move(path), value, std::string(unit), std::string(meaning)});
}

void StatsTree::add_real(std::string path, std::optional<double> value, std::string_view unit,
                         std::string_view meaning) {
  StatsEntry entry{std::move(path), {}, std::string(unit), std::string(meaning)};
  if (value && !std::isfinite(*value)) {
    throw std::logic_error("not a finite number: " + entry.path);
  }
  if (value) entry.value = *value;
  add_entry(std::move(entry));
}

void StatsTree::add_quotient(std::string path, double numerator, double denominator,
                             std::string_view unit, std::string_view meaning) {
  std::optional<double> quotient;
  if (denominator != 0) quotient = numerator / denominator;
  add_real(std::move(path), quotient, unit, meaning);
}

void StatsTree::add_text(std::string path, std::string value, std::string_view meaning) {
  add_entry({std::move(path), std::move(value), "text", std::string(meaning)});
}

const StatsEntry* StatsTree::find(const std::string& path) const {
  const auto it = index_.find(path);
  return it == index_.end() ? nullptr : &entries_[it->second];
}

std::uint64_t StatsTree::count(const std::string& path) const {
  const StatsEntry* entry = find(path);
  if (entry == nullptr) throw std::out_of_range("not reported: " + path);
  const auto* value = std::get_if<std::uint64_t>(&entry->value);
  if (value == nullptr) throw std::out_of_range("not a counter: " + path);
  return *value;
}

}  // namespace sheaf
