// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "tracefile/byte_order.h"

namespace sheaf {

/// A column of numbers that is packed as it comes.
class NumberColumn {
 public:
  void put(std::uint64_t value) {
    if (bytes_.size() - size_ < kMaxBytes) bytes_.resize(2 * bytes_.size() + kMaxBytes);
    std::uint8_t* next = bytes_.data() + size_;
    for (; value >= 0x80; value >>= 7) *next++ = static_cast<std::uint8_t>(value | 0x80);
    *next++ = static_cast<std::uint8_t>(value);
    size_ = static_cast<std::size_t>(next - bytes_.data());
  }
  [[nodiscard]] ByteSpan bytes() const { return {bytes_.data(), size_}; }

 private:
  static constexpr std::size_t kMaxBytes = 10;  ///< of 64 bits, seven in each
  ByteVector bytes_;
  std::size_t size_ = 0;
};

/// A frame's content is a sequence of columns, each with its length in bytes (32 bits) in front.
/// Numbers are varints: seven bits a byte, the least significant first, the high bit set in all
/// bytes but the last. Floats are words: XORed with the word before, then all lowest bytes, all
/// second bytes, and so on, so that equal and similar values make runs that compress.
class ColumnWriter {
 public:
  explicit ColumnWriter(ByteVector& out) : out_(out) {}
  void bytes(ByteSpan values);
  void numbers(const NumberColumn& values) { bytes(values.bytes()); }
  void words(std::span<const std::uint32_t> values);
  void longs(std::span<const std::uint64_t> values);

 private:
  template <typename Fill>
  void column(const Fill& fill);
  ByteVector& out_;
};

/// What a column reader throws; the caller knows the place.
struct BadColumn : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads columns in the order in which they were written; every count is checked.
class ColumnReader {
 public:
  explicit ColumnReader(ByteSpan raw) : raw_(raw) {}
  void bytes(std::size_t count, std::vector<std::uint8_t>& values);
  void varints(std::size_t count, std::vector<std::uint64_t>& values);
  void words(std::size_t count, std::vector<std::uint32_t>& values);
  void longs(std::size_t count, std::vector<std::uint64_t>& values);
  void finish() const;  ///< nothing may be left

 private:
  ByteSpan next_column();
  ByteSpan raw_;
  std::size_t position_ = 0;
};

/// Signed numbers as unsigned ones: 0, -1, 1, -2 … become 0, 1, 2, 3 …
[[nodiscard]] constexpr std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
[[nodiscard]] constexpr std::int64_t unzigzag(std::uint64_t code) {
  return static_cast<std::int64_t>(code >> 1) ^ -static_cast<std::int64_t>(code & 1);
}

}  // namespace sheaf
