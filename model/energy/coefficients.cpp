// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/coefficients.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "config/dram/presets.h"

namespace sheaf {
namespace {

struct Point {
  double bytes;
  double picojoule;
};
constexpr std::array kSram{Point{8192, Coefficients::sram_8kib.value},
                           Point{32768, Coefficients::sram_32kib.value},
                           Point{1048576, Coefficients::sram_1mib.value}};

std::string line(const Coefficient& c) {
  return fmt::format("{:<17} {:>8} {} ({})\n  {}\n  checked against: {}\n", c.name, c.value, c.unit,
                     c.node, c.source, c.check);
}

std::string line(std::string_view name, const std::optional<double>& value, std::string_view unit) {
  return value ? fmt::format("  .{:<22} {:>9.2f} {}\n", name, *value, unit)
               : fmt::format("  .{:<22}   unknown\n", name);
}

std::string preset_lines(const DramPreset& preset) {
  const DramEnergyTable& e = preset.energy;
  return fmt::format("\n{}\n  {}\n", preset.name, e.source) +
         line("activate_precharge", e.activate_precharge_pj, "pJ each") +
         line("read", e.read_pj, "pJ a burst") + line("write", e.write_pj, "pJ a burst") +
         line("refresh", e.refresh_pj, "pJ each") +
         line("active_standby", e.active_standby_mw, "mW a rank") +
         line("precharge_standby", e.precharge_standby_mw, "mW a rank");
}

}  // namespace

std::span<const Coefficient> Coefficients::all() {
#define SHEAF_COEFFICIENT_NAME(name, value, unit, node, source, check) name,
  static constexpr std::array kAll{SHEAF_COEFFICIENTS(SHEAF_COEFFICIENT_NAME)};
#undef SHEAF_COEFFICIENT_NAME
  return kAll;
}

double sram_word_picojoule(double bytes) {
  const bool small = bytes < kSram[1].bytes;
  const Point& a = small ? kSram[0] : kSram[1];
  const Point& b = small ? kSram[1] : kSram[2];
  const double exponent = std::log(b.picojoule / a.picojoule) / std::log(b.bytes / a.bytes);
  return a.picojoule * std::pow(bytes / a.bytes, exponent);
}

double sram_square_millimetres(double bits) {
  return bits * Coefficients::sram_cell.value / Coefficients::array_efficiency.value * 1e-6;
}

std::string print_coefficients() {
  std::string text = "Units and SRAM\n\n";
  for (const Coefficient& coefficient : Coefficients::all()) text += line(coefficient);
  text += "\nDRAM, by command; what no source gives is unknown, not zero\n";
  for (const DramPreset& preset : dram_presets()) text += preset_lines(preset);
  return text;
}

}  // namespace sheaf
