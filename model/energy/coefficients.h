// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/units.h"

namespace sheaf {

/// What one event costs, or one bit takes: declared once, below, with where the number is from.
struct Coefficient {
  std::string_view name;
  double value = 0;
  std::string_view unit;
  std::string_view node;    ///< technology and supply
  std::string_view source;  ///< where the number was published
  std::string_view check;   ///< against what it was checked; "nothing" if it was not
};

/// The node at which everything but DRAM is stated; no coefficient is of another, so none is
/// scaled.
inline constexpr std::string_view kTechnologyNode = "45 nm";

// Sources. Horowitz: M. Horowitz, "Computing's energy problem (and what we can do about it)", ISSCC
// 2014, energies of operations and cache accesses at 45 nm and 0.9 V.
#define SHEAF_HOROWITZ "Horowitz, ISSCC 2014"
#define SHEAF_GIST "V0XNIHILI's gist 2b6fa61e, which quotes the paper's table"
#define SHEAF_FRONTIERS "PMC8934428, table 3, which quotes the paper's table"

#define SHEAF_COEFFICIENTS(X)                                                                    \
  X(int8_add, 0.03, "pJ", "45 nm, 0.9 V", SHEAF_HOROWITZ, SHEAF_GIST)                            \
  X(int8_multiply, 0.2, "pJ", "45 nm, 0.9 V", SHEAF_HOROWITZ, SHEAF_GIST)                        \
  X(int32_add, 0.1, "pJ", "45 nm, 0.9 V", SHEAF_HOROWITZ, SHEAF_FRONTIERS)                       \
  X(fp16_add, 0.4, "pJ", "45 nm, 0.9 V", SHEAF_HOROWITZ, SHEAF_GIST)                             \
  X(fp32_add, 0.9, "pJ", "45 nm, 0.9 V", SHEAF_HOROWITZ, SHEAF_FRONTIERS)                        \
  X(fp32_multiply, 3.7, "pJ", "45 nm, 0.9 V", SHEAF_HOROWITZ, SHEAF_FRONTIERS)                   \
  X(fp32_compare, 0.1, "pJ", "45 nm, 0.9 V",                                                     \
    SHEAF_HOROWITZ ": int32 add, as IEEE 754 numbers compare like signed integers",              \
    SHEAF_FRONTIERS)                                                                             \
  X(fp32_divide, 26.3, "pJ", "45 nm, 0.9 V",                                                     \
    SHEAF_HOROWITZ ", multiply x 7.1, a ratio measured on a Cortex-M4F", SHEAF_FRONTIERS)        \
  X(fp32_square_root, 26.3, "pJ", "45 nm, 0.9 V", "taken to cost a division",                    \
    "nothing: unverified")                                                                       \
  X(sram_8kib, 10, "pJ per 64 bits", "45 nm, 0.9 V", SHEAF_HOROWITZ, SHEAF_GIST)                 \
  X(sram_32kib, 20, "pJ per 64 bits", "45 nm, 0.9 V", SHEAF_HOROWITZ, SHEAF_GIST)                \
  X(sram_1mib, 100, "pJ per 64 bits", "45 nm, 0.9 V", SHEAF_HOROWITZ, SHEAF_GIST)                \
  X(sram_cell, 0.29565, "um2 per bit", "45 nm", "CACTI 7: 146 F2, F = 45 nm, one port",          \
    "HewlettPackard/cacti, tech_params/45nm.dat")                                                \
  X(array_efficiency, 0.7, "1", "any", "choice of this project: cells' share of a macro's area", \
    "nothing: unverified")

/// The table; `sheaf coefficients` prints it.
struct Coefficients {
#define SHEAF_COEFFICIENT_MEMBER(name, value, unit, node, source, check) \
  static constexpr Coefficient name{#name, value, unit, node, source, check};
  SHEAF_COEFFICIENTS(SHEAF_COEFFICIENT_MEMBER)
#undef SHEAF_COEFFICIENT_MEMBER
  [[nodiscard]] static std::span<const Coefficient> all();
};

/// Energy of reading or writing 64 bits of an SRAM, pJ. Between the three published sizes a power
/// law through the neighbours; beyond them their outer law goes on (near the square root of the
/// size, as the wires' lengths). The table gives no writes apart: they count as reads.
[[nodiscard]] double sram_word_picojoule(double bytes);

/// Area of an SRAM of so many bits, mm2: cells / array efficiency.
[[nodiscard]] double sram_square_millimetres(double bits);

/// Fixed-width text: the table, then the energies by which DRAM presets are counted.
[[nodiscard]] std::string print_coefficients();

}  // namespace sheaf
