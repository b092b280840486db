// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace sheaf {

using ByteVector = std::vector<std::uint8_t>;
using ByteSpan = std::span<const std::uint8_t>;

/// Appends an unsigned integer, least significant byte first.
template <typename T>
void put_le(ByteVector& out, T value) {
  static_assert(std::is_unsigned_v<T>);
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    out.push_back(static_cast<std::uint8_t>(std::uint64_t{value} >> (8 * i)));
  }
}

/// The unsigned integer at `offset`, least significant byte first; the caller has checked the size.
template <typename T>
[[nodiscard]] T get_le(ByteSpan bytes, std::size_t offset) {
  static_assert(std::is_unsigned_v<T>);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    value |= std::uint64_t{bytes[offset + i]} << (8 * i);
  }
  return static_cast<T>(value);
}

}  // namespace sheaf
