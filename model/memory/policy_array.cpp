// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/policy_array.h"

#include <algorithm>

namespace sheaf {

PolicyArray::PolicyArray(const ArrayShape& shape)
    : ways_(shape.ways),
      sector_shift_(static_cast<unsigned>(std::countr_zero(shape.sectors))),
      sector_mask_(shape.sectors - 1),
      set_mask_(shape.sets - 1),
      replacement_(shape.replacement),
      entries_(shape.sets * shape.ways),
      plru_(shape.replacement == Replacement::kPlru ? shape.sets : 0, shape.ways),
      random_(shape.seed) {}

PolicyArray::Entry* PolicyArray::find(std::uint64_t block) {
  if (entries_.empty()) return nullptr;
  Entry* const set = set_of(block);
  const std::uint64_t wanted = (block >> sector_shift_) + 1;
  for (std::uint32_t way = 0; way < ways_; ++way) {
    if (set[way].tag == wanted) return set + way;
  }
  return nullptr;
}

bool PolicyArray::holds(std::uint64_t block) const {
  const Entry* const entry = const_cast<PolicyArray*>(this)->find(block);
  return entry != nullptr && (entry->valid & bit_of(block)) != 0;
}

void PolicyArray::use(std::uint64_t block, const Entry& entry) {
  Entry* const set = set_of(block);
  const auto way = &entry - set;
  if (replacement_ == Replacement::kLru) std::rotate(set, set + way, set + way + 1);
  if (replacement_ == Replacement::kPlru) {
    plru_.use(set_number(block), static_cast<std::uint32_t>(way));
  }
}

bool PolicyArray::touch(std::uint64_t block) {
  const Entry* const entry = find(block);
  if (entry == nullptr || (entry->valid & bit_of(block)) == 0) return false;
  use(block, *entry);
  return true;
}

// An empty way if there is one.
std::uint32_t PolicyArray::choose_way(std::uint64_t block) {
  if (is_ordered()) return ways_ - 1;
  const Entry* const set = set_of(block);
  for (std::uint32_t way = 0; way < ways_; ++way) {
    if (set[way].tag == 0) return way;
  }
  if (replacement_ == Replacement::kPlru) return plru_.victim(set_number(block));
  return static_cast<std::uint32_t>(random_.below(ways_));
}

CacheVictim PolicyArray::fill(std::uint64_t block, bool dirty) {
  if (entries_.empty()) return {true, dirty ? 1U : 0U, block};
  const std::uint32_t bit = bit_of(block);
  const std::uint32_t dirty_bit = dirty ? bit : 0;
  if (Entry* const entry = find(block)) {
    entry->valid |= bit;
    entry->dirty |= dirty_bit;
    use(block, *entry);
    return {};
  }
  Entry* const set = set_of(block);
  Entry* const way = set + choose_way(block);
  const CacheVictim victim{way->tag != 0, way->dirty, first_block(*way)};
  *way = {(block >> sector_shift_) + 1, bit, dirty_bit};
  if (replacement_ == Replacement::kFifo) std::rotate(set, way, way + 1);
  use(block, *way);
  return victim;
}

}  // namespace sheaf
