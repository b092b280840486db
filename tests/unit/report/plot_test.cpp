// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sheaf::test {
namespace {

AxisRange range_of(PlotScale scale, const std::vector<double>& values) {
  AxisRange range(scale);
  for (const double value : values) range.include(value);
  range.round();
  return range;
}

TEST(PlotAxis, LinearTicksAreRoundNumbersThatEncloseTheValues) {
  const AxisRange range = range_of(PlotScale::kLinear, {0.13, 0.88});
  EXPECT_EQ(range.ticks().front(), 0.1);
  EXPECT_NEAR(range.ticks().back(), 0.9, 1e-12);
  EXPECT_NEAR(range.position(0.5), 0.5, 1e-12);
}

TEST(PlotAxis, LogarithmicTicksAreWholePowers) {
  EXPECT_EQ(range_of(PlotScale::kLog10, {3, 2000}).ticks(),
            (std::vector<double>{1, 10, 100, 1000, 10000}));
  EXPECT_EQ(range_of(PlotScale::kLog2, {1024, 3000}).ticks(),
            (std::vector<double>{1024, 2048, 4096}));
}

TEST(PlotAxis, EqualDistancesOnALogarithmicAxisAreEqualRatios) {
  const AxisRange range = range_of(PlotScale::kLog10, {1, 10000});
  EXPECT_NEAR(range.position(100), 0.5, 1e-12);
}

TEST(PlotAxis, ShowsOnlyWhatHasAPlaceOnIt) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(AxisRange(PlotScale::kLinear).can_show(infinity));
  EXPECT_FALSE(AxisRange(PlotScale::kLinear).can_show(std::nan("")));
  EXPECT_TRUE(AxisRange(PlotScale::kLinear).can_show(0));
  EXPECT_FALSE(AxisRange(PlotScale::kLog2).can_show(0));
}

TEST(PlotAxis, HasALengthEvenForOneValueOrNone) {
  for (const double value : {0.0, 7.0, -3.0}) {
    const AxisRange range = range_of(PlotScale::kLinear, {value});
    EXPECT_GT(range.position(value), 0);
    EXPECT_LT(range.position(value), 1);
  }
  EXPECT_GE(range_of(PlotScale::kLog10, {}).ticks().size(), 2U);
}

Plot two_series() {
  const double nothing = std::nan("");
  return {.title = "Misses",
          .x = {.label = "capacity", .scale = PlotScale::kLog2},
          .y = {.label = "miss ratio"},
          .series = {{.name = "nodes", .points = {{1024, 0.5}, {2048, nothing}, {4096, 0.1}}},
                     {.name = "all",
                      .points = {{1024, 0.6, "first"}, {4096, 0.2}},
                      .style = PlotStyle::kLineAndMarks}},
          .marks = {{2048, "knee"}}};
}

TEST(Plot, IsTheSameFileEachTime) {
  EXPECT_EQ(plot_svg(two_series()), plot_svg(two_series()));
  EXPECT_EQ(plot_png(two_series()), plot_png(two_series()));
}

TEST(Plot, HasTheFormatAskedFor) {
  const auto svg = plot_svg(two_series());
  EXPECT_EQ(std::string(svg.begin(), svg.begin() + 5), "<?xml");
  EXPECT_EQ(plot_png(two_series())[1], 'P');
}

TEST(Plot, LeavesOutWhatCannotBeShown) {
  Plot with = two_series();
  with.series[1].points.push_back({-1, 0.4});  // no place on a logarithmic axis
  EXPECT_EQ(plot_svg(with), plot_svg(two_series()));
}

TEST(Plot, ShowsEachPoint) {
  Plot other = two_series();
  other.series[0].points[2].y = 0.2;
  EXPECT_NE(plot_png(other), plot_png(two_series()));
}

// The range below needs a longer step between its ticks than the one it was widened by.
TEST(AxisRange, HasNoTickOutsideOfItself) {
  AxisRange range(PlotScale::kLog10);
  range.include(3.36e-11);
  range.include(1.88e-3);
  range.round();
  for (const double tick : range.ticks()) {
    EXPECT_GE(range.position(tick), -1e-9) << tick;
    EXPECT_LE(range.position(tick), 1 + 1e-9) << tick;
  }
}

}  // namespace
}  // namespace sheaf::test
