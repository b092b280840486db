// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sheaf {

enum class PlotScale : std::uint8_t { kLinear, kLog2, kLog10 };

/// What a plot says along one axis.
struct PlotAxis {
  std::string label;
  PlotScale scale = PlotScale::kLinear;
  /// Text of a tick; none: the number in its shortest form.
  std::function<std::string(double)> tick_text = {};
};

/// One axis with its range: where values lie along it, and where its ticks are.
class AxisRange {
 public:
  explicit AxisRange(PlotScale scale) : scale_(scale) {}

  /// Whether a value can stand on the axis: finite, and above zero on a logarithmic one.
  [[nodiscard]] bool can_show(double value) const;
  /// Widens the range to hold a value that can be shown.
  void include(double value);
  /// Widens the range to whole ticks; one that holds nothing becomes a unit long.
  void round();

  /// 0 at the range's lower end, 1 at its upper.
  [[nodiscard]] double position(double value) const;
  /// Values at which to label the axis, ascending.
  [[nodiscard]] std::vector<double> ticks() const;

 private:
  [[nodiscard]] double to_line(double value) const;
  [[nodiscard]] double from_line(double position) const;
  [[nodiscard]] double step() const;

  PlotScale scale_;
  bool empty_ = true;
  double low_ = 0;  ///< on the line: of a logarithmic axis the logarithm
  double high_ = 1;
};

}  // namespace sheaf
