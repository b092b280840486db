// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/coefficients.h"

#include <gtest/gtest.h>

#include <cmath>

#include "energy/operations.h"

namespace sheaf {
namespace {

TEST(Coefficients, EachHasAValueAUnitANodeASourceAndACheck) {
  ASSERT_GE(Coefficients::all().size(), 14U);
  for (const Coefficient& coefficient : Coefficients::all()) {
    EXPECT_GT(coefficient.value, 0) << coefficient.name;
    for (const std::string_view text : {coefficient.name, coefficient.unit, coefficient.node,
                                        coefficient.source, coefficient.check}) {
      EXPECT_FALSE(text.empty()) << coefficient.name;
    }
    EXPECT_NE(print_coefficients().find(std::string(coefficient.source)), std::string::npos);
  }
}

TEST(Coefficients, SramEnergyGoesThroughThePublishedPoints) {
  EXPECT_DOUBLE_EQ(sram_word_picojoule(8192), 10);
  EXPECT_DOUBLE_EQ(sram_word_picojoule(32768), 20);
  EXPECT_NEAR(sram_word_picojoule(1048576), 100, 1e-9);
}

// Four times 8 KiB cost twice as much: the square root, which goes on below.
TEST(Coefficients, SramEnergyFollowsTheSquareRootBelowThem) {
  EXPECT_NEAR(sram_word_picojoule(2048), 5, 1e-12);
  EXPECT_NEAR(sram_word_picojoule(16384), 10 * std::sqrt(2.0), 1e-12);
}

TEST(Coefficients, SramEnergyGrowsWithItsSize) {
  double last = 0;
  for (double bytes = 64; bytes <= 1 << 26; bytes *= 1.1) {
    EXPECT_GT(sram_word_picojoule(bytes), last) << bytes;
    last = sram_word_picojoule(bytes);
  }
}

// 146 F2 of 45 nm by an efficiency of 0.7.
TEST(Coefficients, AreaIsCellsByArrayEfficiency) {
  EXPECT_NEAR(sram_square_millimetres(1e6), 146 * 0.045 * 0.045 / 0.7, 1e-12);
}

TEST(Coefficients, OperationsAddUp) {
  constexpr Operations kOneOfEach{
      .add = 1, .multiply = 1, .compare = 1, .divide = 1, .square_root = 1};
  EXPECT_NEAR(kOneOfEach.picojoule(), 0.9 + 3.7 + 0.1 + 26.3 + 26.3, 1e-12);
}

}  // namespace
}  // namespace sheaf
