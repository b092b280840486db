// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/latency_record.h"

#include <gtest/gtest.h>

namespace sheaf::test {
namespace {

TEST(LatencyRecord, PercentilesAreThoseOfTheSortedValues) {
  LatencyRecord record;
  for (Cycles i = 100; i >= 1; --i) record.record(i);
  EXPECT_EQ(record.percentile(50), 50U);
  EXPECT_EQ(record.percentile(99), 99U);
  EXPECT_EQ(record.percentile(100), 100U);
  EXPECT_EQ(record.percentile(0), 1U);
  EXPECT_EQ(record.sum(), 5050U);
}

TEST(LatencyRecord, LongLatenciesAreAsExactAsShortOnes) {
  LatencyRecord record;
  for (Cycles i = 0; i < 10; ++i) record.record(i * 1'000'000'007ULL);
  EXPECT_EQ(record.percentile(50), 4 * 1'000'000'007ULL);
  EXPECT_EQ(record.max(), 9 * 1'000'000'007ULL);
}

TEST(LatencyRecord, NothingHasNoLatency) {
  EXPECT_EQ(LatencyRecord().percentile(50), 0U);
}

}  // namespace
}  // namespace sheaf::test
