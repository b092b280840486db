// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/quantities.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/random.h"

namespace sheaf {
namespace {

TEST(Quantities, BytesAreReadInPowersOf1024) {
  EXPECT_EQ(parse_bytes("32KiB"), 32768U);
  EXPECT_EQ(parse_bytes("4 MiB"), Bytes{4} << 20);
  EXPECT_EQ(parse_bytes("1TiB"), Bytes{1} << 40);
  EXPECT_EQ(parse_bytes("512B"), 512U);
  EXPECT_EQ(parse_bytes("512"), 512U);
  EXPECT_EQ(parse_bytes("0"), 0U);
}

TEST(Quantities, WhatIsNoSizeIsRefused) {
  for (const char* text : {"", "KiB", "32kib", "32KB", "1.5KiB", "-1", "+1", " 1", "1 ", "1  KiB",
                           "1KiB ", "0x10", "18446744073709551616", "16777216TiB"}) {
    EXPECT_FALSE(parse_bytes(text)) << text;
  }
}

TEST(Quantities, BytesAreWrittenInTheLargestUnitThatDivides) {
  EXPECT_EQ(format_bytes(32768), "32KiB");
  EXPECT_EQ(format_bytes(1536), "1536B");
  EXPECT_EQ(format_bytes(Bytes{3} << 20), "3MiB");
  EXPECT_EQ(format_bytes(0), "0B");
}

TEST(Quantities, WrittenBytesReadBackExactly) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Bytes bytes = random.next() >> random.below(64) << random.below(20);
    EXPECT_EQ(parse_bytes(format_bytes(bytes)), bytes);
  }
}

TEST(Quantities, FrequenciesAreReadInHertz) {
  EXPECT_EQ(parse_frequency("1.5GHz"), 1.5e9);
  EXPECT_EQ(parse_frequency("800 MHz"), 8e8);
  EXPECT_EQ(parse_frequency("32kHz"), 32e3);
  EXPECT_EQ(parse_frequency("1e9"), 1e9);
  EXPECT_EQ(parse_frequency("50Hz"), 50.0);
}

TEST(Quantities, WhatIsNoFrequencyIsRefused) {
  for (const char* text : {"", "GHz", "1ghz", "1KHz", "-1GHz", "nan", "inf", "infGHz", "1e308GHz",
                           "1GHz ", "1,5GHz"}) {
    EXPECT_FALSE(parse_frequency(text)) << text;
  }
}

TEST(Quantities, WrittenFrequenciesReadBackExactly) {
  EXPECT_EQ(format_frequency(1.5e9), "1.5GHz");
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double hertz = 1e3 + static_cast<double>(random.next() >> random.below(60)) / 7.0;
    EXPECT_EQ(parse_frequency(format_frequency(hertz)), hertz);
  }
}

}  // namespace
}  // namespace sheaf
