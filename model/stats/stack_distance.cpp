// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/stack_distance.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace sheaf {
namespace {

constexpr std::size_t kFirstSlots = 64;

unsigned hash_shift(std::size_t num_slots) {
  return 64U - static_cast<unsigned>(std::countr_zero(num_slots));
}

}  // namespace

StackDistances::StackDistances(std::uint32_t num_sets)
    : set_mask_(num_sets - 1),
      hash_shift_(hash_shift(kFirstSlots)),
      slots_(kFirstSlots),
      orders_(num_sets) {
  if (!std::has_single_bit(num_sets)) throw std::logic_error("sets are no power of two");
}

std::uint32_t StackDistances::access_first(std::uint64_t line, Slot* slot) {
  if (2 * (num_lines_ + 1) > slots_.size()) {
    grow();
    slot = find(line);
  }
  ++num_lines_;
  slot->line = line;
  use(orders_[line & set_mask_], slot);
  return kFirstUse;
}

void StackDistances::renumber(RecencyOrder& order) {
  order.renumber(
      [this](std::uint32_t slot, RecencyOrder::Stamp stamp) { slots_[slot].stamp = stamp; });
}

void StackDistances::grow() {
  if (slots_.size() >= std::size_t{1} << 31) throw std::length_error("more than 2^30 lines");
  std::vector<Slot> smaller(slots_.size() * 2);
  smaller.swap(slots_);
  hash_shift_ = hash_shift(slots_.size());
  for (const Slot& slot : smaller) {
    if (slot.stamp == kEmpty) continue;
    Slot* const place = find(slot.line);
    *place = slot;
    orders_[slot.line & set_mask_].rename(slot.stamp,
                                          static_cast<std::uint32_t>(place - slots_.data()));
  }
}

std::vector<MissCurve::Point> MissCurve::points() const {
  std::vector<Point> points{{0, num_accesses_}};
  std::uint64_t misses = num_accesses_;
  for (std::size_t distance = 0; distance < at_distance_.size(); ++distance) {
    if (at_distance_[distance] == 0) continue;
    misses -= at_distance_[distance];
    points.push_back({distance + 1, misses});
  }
  return points;
}

std::uint64_t misses_at(std::span<const MissCurve::Point> points, std::uint64_t ways) {
  const auto after = std::ranges::upper_bound(points, ways, {}, &MissCurve::Point::ways);
  return std::prev(after)->misses;
}

}  // namespace sheaf
