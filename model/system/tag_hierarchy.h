// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <functional>
#include <utility>
#include <vector>

#include "config/config.h"
#include "memory/cache_array.h"
#include "system/observation.h"

namespace sheaf {

/// The machine's caches without time: which level an access finds its line at, if every access has
/// been dealt with before the next one comes. With LRU what hits is what a stack distance below the
/// associativity says. As in the machine, a line is a sector where lines are divided.
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
  /// A read-modify-write of some bytes of a line of the film.
  Served modify_film(std::uint64_t line, Bytes bytes);
  /// An access to a line of the film that is on its way.
  void merge_film() { ++level(Cache::kFilm).accesses; }
  /// Writes what is dirty in the film's cache back, as at the end of a frame.
  void flush();

  /// Told every request that is left for DRAM; a read is of a line of the L2.
  using DramSink = std::function<void(Address address, Bytes bytes, bool write)>;
  void set_dram_sink(DramSink sink) { dram_sink_ = std::move(sink); }

  /// Adds hits, accesses and DRAM bytes so far.
  void observe(Observation& seen) const;

  [[nodiscard]] const CacheArray& array(Cache cache, std::size_t unit) const {
    return level(cache).units[unit];
  }
  [[nodiscard]] const std::vector<CacheArray>& l2_banks() const { return banks_; }

 private:
  struct Level {
    CacheMode mode{};
    unsigned line_shift = 0;
    std::vector<CacheArray> units;
    std::uint64_t hits = 0;
    std::uint64_t accesses = 0;
    [[nodiscard]] Bytes line_size() const { return Bytes{1} << line_shift; }
  };
  /// A line's bank of the L2, and its number there.
  struct Place {
    std::size_t bank;
    std::uint64_t index;
  };
  [[nodiscard]] const Level& level(Cache cache) const {
    return levels_[static_cast<std::size_t>(cache)];
  }
  Level& level(Cache cache) { return levels_[static_cast<std::size_t>(cache)]; }
  void add_level(Cache cache, const CacheSpec& spec, std::size_t units);
  bool finds(Level& at, std::size_t unit, std::uint64_t line);
  void fill(Level& at, std::size_t unit, std::uint64_t line, bool dirty);
  Served read_l2(Address address);
  void write_l2(Address address, Bytes bytes);
  void put_l2(const Place& where, bool dirty);
  void use_dram(Address address, Bytes bytes, bool write);
  [[nodiscard]] Place place_of(Address address) const;
  [[nodiscard]] Address address_of(const Place& where) const;
  [[nodiscard]] bool l2_finds(const Place& where) {
    return l2_.mode == CacheMode::kPerfect || banks_[where.bank].touch(where.index);
  }
  [[nodiscard]] Bytes l2_line_size() const { return Bytes{1} << l2_line_shift_; }

  std::vector<Level> levels_{kNumCaches};
  const WriteSpec film_write_;
  const L2Spec l2_;
  const unsigned l2_line_shift_, sector_shift_, bank_shift_;
  std::vector<CacheArray> banks_;
  std::uint64_t l2_hits_ = 0;
  std::uint64_t l2_accesses_ = 0;
  Bytes dram_bytes_ = 0;
  DramSink dram_sink_;
};

}  // namespace sheaf
