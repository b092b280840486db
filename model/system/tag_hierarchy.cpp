// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/tag_hierarchy.h"

#include <array>

namespace sheaf {
namespace {

unsigned shift_of(std::uint64_t power_of_two) {
  return static_cast<unsigned>(std::countr_zero(power_of_two));
}

}  // namespace

TagHierarchy::TagHierarchy(const Config& config)
    : film_write_(config.film_cache.write),
      l2_(config.l2),
      l2_line_shift_(shift_of(config.l2.line / config.l2.sectors)),
      sector_shift_(shift_of(config.l2.sectors)),
      bank_shift_(shift_of(config.l2.banks)) {
  add_level(Cache::kNode, config.node_cache, config.traversal_unit.count);
  add_level(Cache::kTriangle, config.triangle_cache, config.intersection_unit.count);
  add_level(Cache::kAttribute, config.attribute_cache, config.shader_unit.count);
  add_level(Cache::kTexture, config.texture_cache, config.shader_unit.count);
  add_level(Cache::kFilm, config.film_cache, 1);
  for (std::uint32_t bank = 0; bank < l2_.banks; ++bank) {
    banks_.emplace_back(bank_shape(l2_, l2_.banks));
  }
}

void TagHierarchy::add_level(Cache cache, const CacheSpec& spec, std::size_t units) {
  Level& added = level(cache);
  added.mode = spec.mode;
  added.line_shift = shift_of(spec.line / spec.sectors);
  for (std::size_t unit = 0; unit < units; ++unit) added.units.emplace_back(bank_shape(spec, 1));
}

bool TagHierarchy::finds(Level& at, std::size_t unit, std::uint64_t line) {
  ++at.accesses;
  const bool found = at.mode == CacheMode::kPerfect || at.units[unit].touch(line);
  if (found) ++at.hits;
  return found;
}

void TagHierarchy::fill(Level& at, std::size_t unit, std::uint64_t line, bool dirty) {
  const CacheVictim victim = at.units[unit].fill(line, dirty);
  for (std::uint32_t left = victim.dirty; left != 0; left &= left - 1) {
    const std::uint64_t leaving = victim.line + static_cast<std::uint32_t>(std::countr_zero(left));
    write_l2(leaving << at.line_shift, at.line_size());
  }
}

TagHierarchy::Served TagHierarchy::read(Cache cache, std::size_t unit, std::uint64_t line) {
  Level& at = level(cache);
  if (finds(at, unit, line)) return Served::kPrivate;
  const Served served = read_l2(line << at.line_shift);
  fill(at, unit, line, false);
  return served;
}

TagHierarchy::Served TagHierarchy::modify_film(std::uint64_t line, Bytes bytes) {
  Level& film = level(Cache::kFilm);
  const bool back = film_write_.policy == WritePolicy::kBack;
  const Address address = line << film.line_shift;
  if (finds(film, 0, line)) {
    if (film.mode == CacheMode::kPerfect) return Served::kPrivate;
    if (back) {
      film.units[0].mark_dirty(line);
    } else {
      write_l2(address, bytes);
    }
    return Served::kPrivate;
  }
  const Served served = read_l2(address);
  if (!back || !film_write_.allocate) write_l2(address, film.line_size());
  if (film_write_.allocate) fill(film, 0, line, back);
  return served;
}

TagHierarchy::Place TagHierarchy::place_of(Address address) const {
  const std::uint64_t line = address >> l2_line_shift_;
  const std::uint64_t tag = line >> sector_shift_;
  return {tag & (banks_.size() - 1),
          (tag >> bank_shift_) << sector_shift_ | (line & (l2_.sectors - 1))};
}

Address TagHierarchy::address_of(const Place& where) const {
  const std::uint64_t tag = (where.index >> sector_shift_) << bank_shift_ | where.bank;
  return (tag << sector_shift_ | (where.index & (l2_.sectors - 1))) << l2_line_shift_;
}

void TagHierarchy::use_dram(Address address, Bytes bytes, bool write) {
  dram_bytes_ += bytes;
  if (dram_sink_) dram_sink_(address, bytes, write);
}

void TagHierarchy::put_l2(const Place& where, bool dirty) {
  const CacheVictim victim = banks_[where.bank].fill(where.index, dirty);
  for (std::uint32_t left = victim.dirty; left != 0; left &= left - 1) {
    const std::uint64_t leaving = victim.line + static_cast<std::uint32_t>(std::countr_zero(left));
    use_dram(address_of({where.bank, leaving}), l2_line_size(), true);
  }
}

TagHierarchy::Served TagHierarchy::read_l2(Address address) {
  ++l2_accesses_;
  const Place where = place_of(address);
  if (l2_finds(where)) {
    ++l2_hits_;
    return Served::kL2;
  }
  use_dram(address_of(where), l2_line_size(), false);
  put_l2(where, false);
  return Served::kDram;
}

void TagHierarchy::write_l2(Address address, Bytes bytes) {
  ++l2_accesses_;
  const Place where = place_of(address);
  const bool back = l2_.write.policy == WritePolicy::kBack;
  const bool stores = l2_.mode == CacheMode::kNormal;
  if (l2_finds(where)) {
    ++l2_hits_;
    if (stores && back) banks_[where.bank].mark_dirty(where.index);
    if (stores && !back) use_dram(address, bytes, true);
    return;
  }
  const bool allocates = stores && l2_.write.allocate;
  if (allocates) {
    if (bytes != l2_line_size()) use_dram(address_of(where), l2_line_size(), false);
    put_l2(where, back);
  }
  if (!allocates || !back) use_dram(address, bytes, true);
}

void TagHierarchy::flush() {
  Level& film = level(Cache::kFilm);
  film.units[0].clean_all(
      [&](std::uint64_t line) { write_l2(line << film.line_shift, film.line_size()); });
}

void TagHierarchy::observe(Observation& seen) const {
  using enum Observed;
  constexpr std::array<std::array<Observed, 2>, kNumCaches> kNames{
      {{kNodeHits, kNodeAccesses},
       {kTriangleHits, kTriangleAccesses},
       {kAttributeHits, kAttributeAccesses},
       {kTextureHits, kTextureAccesses},
       {kFilmHits, kFilmAccesses}}};
  for (std::size_t cache = 0; cache < kNumCaches; ++cache) {
    seen[kNames[cache][0]] += levels_[cache].hits;
    seen[kNames[cache][1]] += levels_[cache].accesses;
  }
  seen[kL2Hits] += l2_hits_;
  seen[kL2Accesses] += l2_accesses_;
  seen[kDramBytes] += dram_bytes_;
}

}  // namespace sheaf
