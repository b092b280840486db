// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/event_sort.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace sheaf {
namespace {

constexpr unsigned kDigitBits = 12;
constexpr unsigned kNumPasses = 3;  // 36 bits: the 34 of coordinate and kind, and two idle ones
constexpr std::size_t kNumDigits = std::size_t{1} << kDigitBits;

std::size_t digit(SplitEvent event, unsigned pass) {
  return static_cast<std::size_t>(event >> (kEventTriangleBits + pass * kDigitBits)) &
         (kNumDigits - 1);
}

void scatter_by_digit(std::span<const SplitEvent> from, std::span<SplitEvent> to, unsigned pass) {
  std::array<std::size_t, kNumDigits> next{};
  for (const SplitEvent event : from) ++next[digit(event, pass)];
  std::size_t first = 0;
  for (std::size_t& slot : next) {
    const std::size_t count = slot;
    slot = first;
    first += count;
  }
  for (const SplitEvent event : from) to[next[digit(event, pass)]++] = event;
}

}  // namespace

void sort_events(std::span<SplitEvent> events, std::span<SplitEvent> scratch) {
  std::span<SplitEvent> from = events;
  std::span<SplitEvent> to = scratch.first(events.size());
  for (unsigned pass = 0; pass < kNumPasses; ++pass) {
    scatter_by_digit(from, to, pass);
    std::swap(from, to);
  }
  std::copy(from.begin(), from.end(), to.begin());  // an odd number of passes ends in the scratch
}

}  // namespace sheaf
