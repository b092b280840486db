// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/quantities.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace sheaf {
namespace {

struct ByteUnit {
  std::string_view name;
  Bytes scale;
};
constexpr std::array<ByteUnit, 5> kByteUnits{{{"TiB", Bytes{1} << 40},
                                              {"GiB", Bytes{1} << 30},
                                              {"MiB", Bytes{1} << 20},
                                              {"KiB", Bytes{1} << 10},
                                              {"B", 1}}};

struct FrequencyUnit {
  std::string_view name;
  double scale;
};
constexpr std::array<FrequencyUnit, 5> kFrequencyUnits{
    {{"THz", 1e12}, {"GHz", 1e9}, {"MHz", 1e6}, {"kHz", 1e3}, {"Hz", 1}}};

template <typename Number>
struct Quantity {
  Number number{};
  std::string_view unit;
};

/// Splits "1.5 GHz" into the longest leading number and what follows it.
template <typename Number>
std::optional<Quantity<Number>> split(std::string_view text) {
  Quantity<Number> quantity;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, quantity.number);
  if (error != std::errc{}) return std::nullopt;
  quantity.unit = std::string_view(rest, static_cast<std::size_t>(end - rest));
  if (quantity.unit.size() > 1 && quantity.unit.front() == ' ') quantity.unit.remove_prefix(1);
  return quantity;
}

}  // namespace

std::optional<Bytes> parse_bytes(std::string_view text) {
  const auto quantity = split<Bytes>(text);
  if (!quantity) return std::nullopt;
  for (const auto& [name, scale] : kByteUnits) {
    if (quantity->unit != name && !(quantity->unit.empty() && scale == 1)) continue;
    if (quantity->number > std::numeric_limits<Bytes>::max() / scale) return std::nullopt;
    return quantity->number * scale;
  }
  return std::nullopt;
}

std::string format_bytes(Bytes bytes) {
  for (const auto& [name, scale] : kByteUnits) {
    if (bytes >= scale && bytes % scale == 0) return fmt::format("{}{}", bytes / scale, name);
  }
  return "0B";
}

std::optional<double> parse_frequency(std::string_view text) {
  const auto quantity = split<double>(text);
  if (!quantity || !std::isfinite(quantity->number) || quantity->number < 0) return std::nullopt;
  for (const auto& [name, scale] : kFrequencyUnits) {
    if (quantity->unit != name && !(quantity->unit.empty() && scale == 1)) continue;
    const double hertz = quantity->number * scale;
    return std::isfinite(hertz) ? std::optional(hertz) : std::nullopt;
  }
  return std::nullopt;
}

std::string format_frequency(double hertz) {
  for (const auto& [name, scale] : kFrequencyUnits) {
    if (hertz < scale) continue;
    std::string text = fmt::format("{}{}", hertz / scale, name);
    // Dividing by the scale may round; such a frequency is told in a smaller unit.
    if (parse_frequency(text) == hertz) return text;
  }
  return fmt::format("{}Hz", hertz);
}

}  // namespace sheaf
