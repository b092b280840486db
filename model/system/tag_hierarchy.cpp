// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/tag_hierarchy.h"

#include <array>

namespace sheaf {

TagHierarchy::TagHierarchy(const Config& config)
    : l2_mode_(config.l2.mode),
      l2_line_(config.l2.line),
      l2_line_shift_(static_cast<unsigned>(std::countr_zero(config.l2.line))),
      bank_shift_(static_cast<unsigned>(std::countr_zero(config.l2.banks))) {
  add_level(Cache::kNode, config.node_cache, config.traversal_unit.count);
  add_level(Cache::kTriangle, config.triangle_cache, config.intersection_unit.count);
  add_level(Cache::kAttribute, config.attribute_cache, config.shader_unit.count);
  add_level(Cache::kTexture, config.texture_cache, config.shader_unit.count);
  add_level(Cache::kFilm, config.film_cache, 1);
  const L2Spec& l2 = config.l2;
  const Bytes row = l2.line * l2.ways * l2.banks;
  const auto sets =
      l2.mode == CacheMode::kNormal ? static_cast<std::uint32_t>(l2.capacity / row) : 0;
  for (std::uint32_t bank = 0; bank < l2.banks; ++bank) banks_.emplace_back(sets, l2.ways);
}

void TagHierarchy::add_level(Cache cache, const CacheSpec& spec, std::size_t units) {
  Level& added = level(cache);
  added.mode = spec.mode;
  added.line = spec.line;
  added.line_shift = static_cast<unsigned>(std::countr_zero(spec.line));
  const auto sets = spec.mode == CacheMode::kNormal
                        ? static_cast<std::uint32_t>(spec.capacity / (spec.line * spec.ways))
                        : 0;
  for (std::size_t unit = 0; unit < units; ++unit) added.units.emplace_back(sets, spec.ways);
}

TagHierarchy::Served TagHierarchy::read(Cache cache, std::size_t unit, std::uint64_t line) {
  return fetch(level(cache), unit, line, false);
}

TagHierarchy::Served TagHierarchy::modify(Cache cache, std::size_t unit, std::uint64_t line) {
  return fetch(level(cache), unit, line, true);
}

TagHierarchy::Served TagHierarchy::fetch(Level& at, std::size_t unit, std::uint64_t line,
                                         bool dirty) {
  ++at.accesses;
  CacheArray& array = at.units[unit];
  if (at.mode == CacheMode::kPerfect || array.touch(line)) {
    ++at.hits;
    if (dirty && at.mode == CacheMode::kNormal) array.mark_dirty(line);
    return Served::kPrivate;
  }
  const Served served = read_l2(line << at.line_shift);
  const CacheArray::Victim victim = array.fill(line, dirty);
  if (victim.valid && victim.dirty) write_l2(victim.line << at.line_shift, at.line);
  return served;
}

TagHierarchy::Served TagHierarchy::read_l2(Address address) {
  ++l2_accesses_;
  const std::uint64_t line = address >> l2_line_shift_;
  if (l2_holds(line)) {
    ++l2_hits_;
    return Served::kL2;
  }
  dram_bytes_ += l2_line_;
  const CacheArray::Victim victim = bank_of(line).fill(line >> bank_shift_, false);
  if (victim.valid && victim.dirty) dram_bytes_ += l2_line_;
  return Served::kDram;
}

void TagHierarchy::write_l2(Address address, Bytes bytes) {
  ++l2_accesses_;
  const std::uint64_t line = address >> l2_line_shift_;
  if (!l2_holds(line)) {
    dram_bytes_ += bytes;
    return;
  }
  ++l2_hits_;
  if (l2_mode_ == CacheMode::kNormal) bank_of(line).mark_dirty(line >> bank_shift_);
}

void TagHierarchy::flush() {
  Level& film = level(Cache::kFilm);
  film.units[0].clean_all(
      [&](std::uint64_t line) { write_l2(line << film.line_shift, film.line); });
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
