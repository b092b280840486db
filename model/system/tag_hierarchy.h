// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <vector>

#include "config/config.h"
#include "memory/cache_array.h"
#include "system/observation.h"

namespace sheaf {

/// The machine's caches without time: which level an access finds its line at, if every access has
/// been dealt with before the next one comes. One LRU stack a set, so that what hits is what a
/// stack distance below the associativity says.
class TagHierarchy {
 public:
  explicit TagHierarchy(const Config& config);

  /// Private caches of one kind, one a unit.
  enum class Cache : std::uint8_t { kNode, kTriangle, kAttribute, kTexture, kFilm };
  static constexpr std::size_t kNumCaches = 5;
  enum class Served : std::uint8_t { kPrivate, kL2, kDram };

  [[nodiscard]] std::uint64_t line_of(Cache cache, Address address) const {
    return address >> level(cache).line_shift;
  }
  Served read(Cache cache, std::size_t unit, std::uint64_t line);
  /// A read-modify-write: the line is dirty from now on.
  Served modify(Cache cache, std::size_t unit, std::uint64_t line);
  /// An access to a line that is on its way.
  void merge(Cache cache) { ++level(cache).accesses; }
  /// Writes what is dirty in the film's cache back, as at the end of a frame.
  void flush();

  /// Adds hits, accesses and DRAM bytes so far.
  void observe(Observation& seen) const;

  [[nodiscard]] const CacheArray& array(Cache cache, std::size_t unit) const {
    return level(cache).units[unit];
  }
  [[nodiscard]] const std::vector<CacheArray>& l2_banks() const { return banks_; }

 private:
  struct Level {
    CacheMode mode{};
    Bytes line = 0;
    unsigned line_shift = 0;
    std::vector<CacheArray> units;
    std::uint64_t hits = 0;
    std::uint64_t accesses = 0;
  };
  [[nodiscard]] const Level& level(Cache cache) const {
    return levels_[static_cast<std::size_t>(cache)];
  }
  Level& level(Cache cache) { return levels_[static_cast<std::size_t>(cache)]; }
  void add_level(Cache cache, const CacheSpec& spec, std::size_t units);
  Served fetch(Level& level, std::size_t unit, std::uint64_t line, bool dirty);
  Served read_l2(Address address);
  void write_l2(Address address, Bytes bytes);
  [[nodiscard]] bool l2_holds(std::uint64_t line) {
    return l2_mode_ == CacheMode::kPerfect || bank_of(line).touch(line >> bank_shift_);
  }
  CacheArray& bank_of(std::uint64_t line) { return banks_[line & (banks_.size() - 1)]; }

  std::vector<Level> levels_{kNumCaches};
  CacheMode l2_mode_;
  Bytes l2_line_;
  unsigned l2_line_shift_, bank_shift_;
  std::vector<CacheArray> banks_;
  std::uint64_t l2_hits_ = 0;
  std::uint64_t l2_accesses_ = 0;
  Bytes dram_bytes_ = 0;
};

}  // namespace sheaf
