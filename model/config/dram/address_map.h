// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/units.h"

namespace sheaf {

/// Shape of a memory system; all numbers are powers of two.
struct DramOrganization {
  std::uint32_t channels = 0;
  std::uint32_t ranks = 0;        ///< a channel
  std::uint32_t bank_groups = 0;  ///< a rank
  std::uint32_t banks = 0;        ///< a bank group
  std::uint32_t rows = 0;         ///< a bank
  std::uint32_t columns = 0;      ///< bursts in a row
  std::uint32_t burst_bytes = 0;  ///< bytes that one column command moves

  [[nodiscard]] Bytes capacity() const {
    return Bytes{channels} * ranks * bank_groups * banks * rows * columns * burst_bytes;
  }
  [[nodiscard]] std::uint32_t banks_per_rank() const { return bank_groups * banks; }
  [[nodiscard]] std::uint32_t banks_per_channel() const { return ranks * banks_per_rank(); }
};

/// Where a burst lies.
struct DramLocation {
  std::uint32_t channel = 0, rank = 0, bank_group = 0, bank = 0, row = 0, column = 0;
  bool operator==(const DramLocation&) const = default;
};

/// Cuts an address into the fields of its location. Given as text from the most significant field
/// to the least, over the bits above the byte in a burst:
///     row rank bank bankgroup column:5 channel column:2
/// A field may come in pieces; one piece of it may leave its width out and gets what the others
/// leave. Fields of one element (one rank, one channel) may be left out. Addresses beyond the
/// capacity wrap.
class AddressMap {
 public:
  AddressMap() = default;
  /// Throws Error(kUsage) with the rule that the text breaks: an unknown field, a width that is no
  /// number, or fields with more or fewer bits than the organization needs.
  AddressMap(std::string_view text, const DramOrganization& organization);

  [[nodiscard]] DramLocation locate(Address address) const {
    std::array<std::uint32_t, kNumFields> values{};
    std::uint64_t rest = address >> byte_bits_;
    for (const Piece& piece : pieces_) {
      values[piece.field] |= static_cast<std::uint32_t>(rest & piece.mask) << piece.shift;
      rest >>= piece.bits;
    }
    return {values[0], values[1], values[2], values[3], values[4], values[5]};
  }
  /// The inverse; of the burst's first byte.
  [[nodiscard]] Address address_of(const DramLocation& location) const;

  /// Neighbouring bursts that are sure to lie in one row: 2^(width of the lowest field, if that is
  /// the column).
  [[nodiscard]] std::uint32_t bursts_in_a_run() const { return bursts_in_a_run_; }
  [[nodiscard]] unsigned byte_bits() const { return byte_bits_; }

 private:
  static constexpr std::size_t kNumFields = 6;
  struct Piece {
    std::size_t field = 0;
    unsigned bits = 0;
    unsigned shift = 0;  ///< of its lowest bit within the field
    std::uint64_t mask = 0;
  };
  struct Parsed;
  [[nodiscard]] static std::vector<Parsed> parse(std::string_view text);

  std::vector<Piece> pieces_;  ///< from the least significant on
  unsigned byte_bits_ = 0;
  std::uint32_t bursts_in_a_run_ = 1;
};

}  // namespace sheaf
