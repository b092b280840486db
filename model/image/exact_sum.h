// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sheaf {

/// Exact sum of non-negative finite floats: a fixed-point number wide enough for all of them (the
/// long accumulator of Kulisch, "Computer Arithmetic and Validity", 2nd ed., chapter 8).
///
/// Bit i weighs 2^(i-149): bit 0 is the smallest denormal, FLT_MAX ends at bit 276. The remaining
/// 43 of 320 bits are carry room, so 2^43 contributions of any size cannot overflow. Integer sums
/// do not depend on the order of their terms, and neither does this one.
class ExactSum {
 public:
  /// Adds x, which is finite and not negative.
  void add(float x) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t exponent = (bits >> 23) & 0xffU;
    const std::uint64_t hidden = exponent != 0 ? 1U << 23 : 0U;
    const std::uint64_t mantissa = (bits & 0x7fffffU) | hidden;
    const std::uint32_t shift = exponent != 0 ? exponent - 1 : 0;

    std::size_t word = shift / 64;
    const std::uint32_t offset = shift % 64;
    const std::uint64_t low = mantissa << offset;
    // Two shifts, since one by 64 (offset 0) would be undefined.
    std::uint64_t high = (mantissa >> 1) >> (63 - offset);
    words_[word] += low;
    high += words_[word] < low ? 1 : 0;  // high is below 2^24, the carry cannot overflow it
    words_[++word] += high;
    bool carry = words_[word] < high;
    while (carry && ++word < words_.size()) {
      carry = ++words_[word] == 0;
    }
  }

  /// The sum, rounded once to the nearest float, ties to even; FLT_MAX if it is larger than that.
  [[nodiscard]] float value() const noexcept;

 private:
  std::array<std::uint64_t, 5> words_{};
};

}  // namespace sheaf
