// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/exact_sum.h"

#include <limits>

namespace sheaf {
namespace {

using Words = std::array<std::uint64_t, 5>;

/// Bits [first, first + 24) of the number; those beyond its end are zero.
std::uint32_t bits_from(const Words& words, std::uint32_t first) {
  const std::size_t word = first / 64;
  const std::uint32_t offset = first % 64;
  std::uint64_t bits = words[word] >> offset;
  if (offset > 40 && word + 1 < words.size()) {
    bits |= words[word + 1] << (64 - offset);
  }
  return static_cast<std::uint32_t>(bits & 0xffffffU);
}

/// Whether any bit below `end` is set.
bool any_below(const Words& words, std::uint32_t end) {
  const std::size_t word = end / 64;
  for (std::size_t i = 0; i < word; ++i) {
    if (words[i] != 0) {
      return true;
    }
  }
  return (words[word] & ((std::uint64_t{1} << (end % 64)) - 1)) != 0;
}

}  // namespace

float ExactSum::value() const noexcept {
  std::size_t top_word = words_.size() - 1;
  while (top_word > 0 && words_[top_word] == 0) {
    --top_word;
  }
  // Number of bits up to and with the highest one set.
  const auto width = static_cast<std::uint32_t>(64 * top_word) +
                     static_cast<std::uint32_t>(std::bit_width(words_[top_word]));
  if (width <= 24) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(words_[0]));
  }
  // The 24 highest bits are the mantissa; the rest decides the rounding.
  const std::uint32_t shift = width - 24;
  std::uint32_t mantissa = bits_from(words_, shift);
  const bool half = (words_[(shift - 1) / 64] >> ((shift - 1) % 64) & 1U) != 0;
  if (half && ((mantissa & 1U) != 0 || any_below(words_, shift - 1))) {
    ++mantissa;
  }
  // The hidden bit adds one to the exponent field, and so does a mantissa rounded up to 2^24.
  const std::uint32_t bits = mantissa + (shift << 23);
  constexpr std::uint32_t kInfinity = 0x7f800000U;
  return bits < kInfinity ? std::bit_cast<float>(bits) : std::numeric_limits<float>::max();
}

}  // namespace sheaf
