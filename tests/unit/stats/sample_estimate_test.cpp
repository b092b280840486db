// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/sample_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "base/random.h"

namespace sheaf {
namespace {

using Values = std::vector<double>;

// From tables of Student's distribution, two-sided 95 %.
TEST(StudentT, IsWhatTablesSay) {
  EXPECT_NEAR(student_t_95(1), 12.7062, 1e-4);
  EXPECT_NEAR(student_t_95(2), 4.3027, 1e-4);
  EXPECT_NEAR(student_t_95(7), 2.3646, 1e-4);
  EXPECT_NEAR(student_t_95(10), 2.2281, 1e-4);
  EXPECT_NEAR(student_t_95(120), 1.9799, 1e-4);
  EXPECT_NEAR(student_t_95(100000), 1.9600, 1e-4);
}

TEST(SampleEstimate, OfAWholePopulationIsItsTotal) {
  const Values measured{3, 5, 9};
  const Values rough{1, 2, 4};
  const Estimate estimate = estimate_total({measured, rough, 7}, 3);
  EXPECT_DOUBLE_EQ(estimate.value, 17);
  EXPECT_EQ(estimate.low, estimate.high);
}

TEST(SampleEstimate, IsCertainWhereTheRoughFiguresAreProportional) {
  const Values measured{3, 6, 12};
  const Values rough{1, 2, 4};
  const Estimate estimate = estimate_total({measured, rough, 100}, 50);
  EXPECT_DOUBLE_EQ(estimate.value, 300);
  EXPECT_NEAR(estimate.high - estimate.low, 0, 1e-9);
}

// By hand: without one unit each the estimates are 48, 54 and 40, whose squared deviations sum to
// 98.6667; times 2/3, less 3/12: 49.3333; t with two degrees 4.30265.
TEST(SampleEstimate, HasTheIntervalOfTheJackknife) {
  const Values measured{2, 3, 7};
  const Values rough{1, 2, 3};
  const Estimate estimate = estimate_total({measured, rough, 24}, 12);
  EXPECT_DOUBLE_EQ(estimate.value, 48);
  const double half = 4.302653 * std::sqrt(49.0 + 1.0 / 3.0);
  EXPECT_NEAR(estimate.high - estimate.value, half, 1e-4);
  EXPECT_NEAR(estimate.value - estimate.low, half, 1e-4);
}

TEST(SampleEstimate, AddsWhatIsCertain) {
  const Values measured{2, 3, 7};
  const Values rough{1, 2, 3};
  const Estimate without = estimate_total({measured, rough, 24}, 12);
  const Estimate with = estimate_total({measured, rough, 24, 1000}, 12);
  EXPECT_DOUBLE_EQ(with.value, without.value + 1000);
  EXPECT_NEAR(with.high, without.high + 1000, 1e-9);
  const Estimate alone = estimate_total({{}, {}, 0, 5}, 0);
  EXPECT_EQ(alone.value, 5);
  EXPECT_EQ(alone.low, alone.high);
}

// By hand, of measured 1, 1, 1, 1, 6 and rough figures of 1: estimates without one unit are five
// times 2.25 (four of them) and 1; their variance is 0.25 (mean 2, squares 4 * 0.0625 + 1 over 5),
// fourth moment (4 * 0.25^4 + 1) / 5 = 0.203125, excess 0.25, so that G2 = (6 * 0.25 + 6) * 4 / 6 =
// 5 and the degrees are 2 / (2 / 4 + 5 / 5) = 1.33: one.
TEST(SampleEstimate, CountsFewerDegreesWhereOneUnitMakesUpTheVariance) {
  const Values measured{1, 1, 1, 1, 6};
  const Values rough{1, 1, 1, 1, 1};
  const Estimate estimate = estimate_total({measured, rough, 1}, 1000000);
  EXPECT_DOUBLE_EQ(estimate.value, 2);
  EXPECT_NEAR(estimate.high - estimate.value, 12.7062 * std::sqrt(0.25 * 4), 1e-3);
}

TEST(SampleEstimate, OfARatioCorrectsBothTotals) {
  const Values hits{2, 4};
  const Values rough_hits{1, 2};
  const Values accesses{4, 8};
  const Values rough_accesses{4, 8};
  const Estimate estimate =
      estimate_ratio({hits, rough_hits, 30}, {accesses, rough_accesses, 100}, 20);
  EXPECT_DOUBLE_EQ(estimate.value, 0.6);
  EXPECT_NEAR(estimate.high - estimate.low, 0, 1e-12);
}

TEST(SampleEstimate, IsNoneWhereItCannotBeMade) {
  const Values one{1};
  EXPECT_TRUE(std::isnan(estimate_total({one, one, 9}, 9).value));
  const Values zero{0, 0};
  const Values some{1, 2};
  EXPECT_TRUE(std::isnan(estimate_total({some, zero, 0}, 9).value));
  EXPECT_TRUE(std::isnan(estimate_ratio({some, some, 9}, {zero, some, 9}, 9).value));
}

// 2000 samples of 20 out of 100 with a rough figure that is 20 % off: the interval is there for 95
// %.
TEST(SampleEstimate, CoversTheTruthAsOftenAsItClaims) {
  Random random(7);
  Values truth;
  Values rough;
  for (int i = 0; i < 100; ++i) {
    rough.push_back(1.0 + static_cast<double>(random.uniform()));
    truth.push_back(rough.back() * (2.0 + 0.8 * static_cast<double>(random.uniform())));
  }
  const double total = std::accumulate(truth.begin(), truth.end(), 0.0);
  const double rough_total = std::accumulate(rough.begin(), rough.end(), 0.0);
  int covered = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Values measured;
    Values known;
    std::vector<std::size_t> all(truth.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (std::size_t i = 0; i < 20; ++i) {
      std::swap(all[i], all[i + random.below(all.size() - i)]);
      measured.push_back(truth[all[i]]);
      known.push_back(rough[all[i]]);
    }
    const Estimate estimate = estimate_total({measured, known, rough_total}, truth.size());
    covered += estimate.low <= total && total <= estimate.high ? 1 : 0;
  }
  EXPECT_GT(covered, 1877);  // of 2000 at 95 %, less only once in 1000
  EXPECT_LT(covered, 1990);
}

}  // namespace
}  // namespace sheaf
