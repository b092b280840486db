// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/dram/address_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <optional>
#include <ranges>

#include "base/errors.h"
#include "base/text.h"
#include "config/config_text.h"

namespace sheaf {
namespace {

constexpr std::array<std::string_view, 6> kFieldNames{"channel", "rank", "bankgroup",
                                                      "bank",    "row",  "column"};

[[noreturn]] void refuse(std::string_view text, const std::string& rule) {
  throw Error(ExitCode::kUsage, fmt::format("dram.mapping = \"{}\": {}", printable(text), rule));
}

std::array<std::uint32_t, 6> sizes(const DramOrganization& o) {
  return {o.channels, o.ranks, o.bank_groups, o.banks, o.rows, o.columns};
}

bool separates(char c) {
  return c == ' ' || c == '|' || c == ',' || c == '\t';
}

}  // namespace

struct AddressMap::Parsed {
  std::size_t field = 0;
  std::optional<unsigned> bits;
};

std::vector<AddressMap::Parsed> AddressMap::parse(std::string_view text) {
  std::vector<Parsed> pieces;
  std::size_t position = 0;
  while (position < text.size()) {
    if (separates(text[position])) {
      ++position;
      continue;
    }
    std::size_t end = position;
    while (end < text.size() && !separates(text[end])) ++end;
    const std::string_view token = text.substr(position, end - position);
    position = end;
    const std::size_t colon = token.find(':');
    const std::string_view name = token.substr(0, colon);
    const auto field = std::ranges::find(kFieldNames, name);
    if (field == kFieldNames.end()) {
      refuse(text, fmt::format("unknown field '{}'; fields are {}", printable(name),
                               fmt::join(kFieldNames, ", ")));
    }
    Parsed piece{static_cast<std::size_t>(field - kFieldNames.begin()), std::nullopt};
    if (colon != std::string_view::npos) {
      const std::string_view digits = token.substr(colon + 1);
      unsigned bits = 0;
      const auto [last, error] =
          std::from_chars(digits.data(), digits.data() + digits.size(), bits);
      if (error != std::errc() || last != digits.data() + digits.size() || bits == 0 || bits > 32) {
        refuse(text, fmt::format("'{}' should give a width of 1 to 32 bits, as in column:5",
                                 printable(token)));
      }
      piece.bits = bits;
    }
    pieces.push_back(piece);
  }
  return pieces;
}

AddressMap::AddressMap(std::string_view text, const DramOrganization& organization)
    : byte_bits_(static_cast<unsigned>(std::countr_zero(organization.burst_bytes))) {
  std::vector<Parsed> parsed = parse(text);
  const std::array<std::uint32_t, kNumFields> counts = sizes(organization);
  for (std::size_t field = 0; field < kNumFields; ++field) {
    const auto needed = static_cast<unsigned>(std::countr_zero(counts[field]));
    unsigned given = 0;
    Parsed* open = nullptr;
    for (Parsed& piece : parsed) {
      if (piece.field != field) continue;
      if (piece.bits) {
        given += *piece.bits;
      } else if (open != nullptr) {
        refuse(text, fmt::format("'{}' stands there twice without a width; give one of them a "
                                 "width, as in {}:2",
                                 kFieldNames[field], kFieldNames[field]));
      } else {
        open = &piece;
      }
    }
    if (open != nullptr && given <= needed) {
      open->bits = needed - given;
      given = needed;
    }
    if (given != needed) {
      refuse(text, fmt::format("gives '{}' {} bits, but {} of them need {}", kFieldNames[field],
                               given, counts[field], needed));
    }
  }
  std::array<unsigned, kNumFields> used{};
  for (const auto& piece : std::ranges::reverse_view(parsed)) {
    if (*piece.bits == 0) continue;
    pieces_.push_back(
        {piece.field, *piece.bits, used[piece.field], (std::uint64_t{1} << *piece.bits) - 1});
    used[piece.field] += *piece.bits;
  }
  if (!pieces_.empty() && kFieldNames[pieces_[0].field] == "column") {
    bursts_in_a_run_ = std::uint32_t{1} << pieces_[0].bits;
  }
}

Address AddressMap::address_of(const DramLocation& location) const {
  const std::array<std::uint32_t, kNumFields> values{location.channel,    location.rank,
                                                     location.bank_group, location.bank,
                                                     location.row,        location.column};
  Address address = 0;
  unsigned position = byte_bits_;
  for (const Piece& piece : pieces_) {
    address |= ((values[piece.field] >> piece.shift) & piece.mask) << position;
    position += piece.bits;
  }
  return address;
}

}  // namespace sheaf
