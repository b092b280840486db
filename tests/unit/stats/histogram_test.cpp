// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/histogram.h"

#include <gtest/gtest.h>

#include <limits>

#include "stats/report_tree.h"

namespace sheaf {
namespace {

TEST(Histogram, PowerOfTwoBinsBeginAtTheirLowestValue) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(PowerOfTwoBins::bin(0), 0U);
  EXPECT_EQ(PowerOfTwoBins::bin(kMax), PowerOfTwoBins::kNumBins - 1);
  for (std::size_t i = 1; i < PowerOfTwoBins::kNumBins; ++i) {
    EXPECT_EQ(PowerOfTwoBins::bin(PowerOfTwoBins::lowest(i)), i);
    EXPECT_EQ(PowerOfTwoBins::bin(PowerOfTwoBins::lowest(i) - 1), i - 1);
  }
}

TEST(Histogram, LinearBinsGatherWhatIsAboveInTheLast) {
  FillHistogram histogram;
  for (const std::uint64_t value : {0U, 16U, 16U, 64U, 65U, 1000U}) histogram.record(value);
  EXPECT_EQ(histogram.bin(0), 1U);
  EXPECT_EQ(histogram.bin(16), 2U);
  EXPECT_EQ(histogram.bin(64), 3U);
  EXPECT_EQ(histogram.num(), 6U);
  EXPECT_EQ(histogram.sum(), 1161U);
  EXPECT_EQ(histogram.max(), 1000U);
}

TEST(Histogram, AddingTwoIsRecordingBoth) {
  TimeHistogram a;
  TimeHistogram b;
  a.record(5);
  b.record(100);
  b.record(6);
  a += b;
  EXPECT_EQ(a.num(), 3U);
  EXPECT_EQ(a.sum(), 111U);
  EXPECT_EQ(a.max(), 100U);
  EXPECT_EQ(a.bin(PowerOfTwoBins::bin(5)), 2U);
}

TEST(Histogram, IsReportedFlatWithoutEmptyBins) {
  TimeHistogram histogram;
  for (const std::uint64_t value : {0U, 3U, 9U}) histogram.record(value);
  StatsTree tree;
  add_histogram(tree, "cache.residency", histogram, "rays", "cycles", "Residency");
  ASSERT_EQ(tree.entries().size(), 6U);
  EXPECT_EQ(tree.count("cache.residency.num"), 3U);
  EXPECT_EQ(std::get<double>(tree.find("cache.residency.mean")->value), 4.0);
  EXPECT_EQ(tree.count("cache.residency.max"), 9U);
  EXPECT_EQ(tree.count("cache.residency.bin_0"), 1U);
  EXPECT_EQ(tree.count("cache.residency.bin_2"), 1U);
  EXPECT_EQ(tree.count("cache.residency.bin_8"), 1U);
  EXPECT_EQ(tree.find("cache.residency.max")->unit, "cycles");
  EXPECT_EQ(tree.find("cache.residency.bin_8")->unit, "rays");
}

TEST(Histogram, AnEmptyOneHasNoMean) {
  StatsTree tree;
  add_histogram(tree, "fill", FillHistogram{}, "packets", "rays", "Fill");
  EXPECT_TRUE(std::holds_alternative<std::monostate>(tree.find("fill.mean")->value));
}

}  // namespace
}  // namespace sheaf
