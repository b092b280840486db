// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/plot_axis.h"

namespace sheaf {

struct PlotPoint {
  double x = 0;
  double y = 0;
  std::string label = {};  ///< written beside the point
};

enum class PlotStyle : std::uint8_t { kLine, kMarks, kLineAndMarks };

struct PlotSeries {
  std::string name;  ///< in the legend
  std::vector<PlotPoint> points;
  PlotStyle style = PlotStyle::kLine;
};

/// A dashed line across the plot at one x.
struct PlotMark {
  double x = 0;
  std::string label;
};

/// A chart of y over x. Points that an axis cannot show (not finite, or not above zero on a
/// logarithmic axis) are left out, and a line is interrupted there.
struct Plot {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::vector<PlotMark> marks = {};
};

/// The same chart in two file formats; the same plot gives the same bytes on the same computer
/// (glyphs are those of its sans-serif font).
[[nodiscard]] std::vector<std::uint8_t> plot_svg(const Plot& plot);
[[nodiscard]] std::vector<std::uint8_t> plot_png(const Plot& plot);

}  // namespace sheaf
