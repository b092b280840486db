// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/accuracy/output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "image/compare.h"
#include "report/table.h"
#include "system/observation.h"

namespace sheaf {
namespace {

// Where a logarithmic axis puts what is exact.
constexpr double kLeastPercent = 0.001;
constexpr double kLeastRelMse = 1e-16;

constexpr std::array kLimits{0.01, 0.02, 0.05};

std::size_t quantity_named(std::string_view name) {
  const auto quantities = observed_quantities();
  const auto found =
      std::ranges::find_if(quantities, [&](const Quantity& q) { return q.info.name == name; });
  return static_cast<std::size_t>(found - quantities.begin());
}

// p_t of secondary rays where there are any.
std::size_t p_t_of(const LevelRun& reference) {
  const std::size_t secondary = quantity_named("p_t_secondary");
  const bool any = std::isfinite(reference.quantities[secondary].value);
  return any ? secondary : quantity_named("p_t_primary");
}

// What could not be formed, such as p_t where no ray meets the scene, is a dash for people and
// nothing in a CSV file.

std::string percent(double share) {
  if (!std::isfinite(share)) return "-";
  return share == 0.0 ? "0" : fmt::format("{:+.3f}", 100.0 * share);
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "";
}

/// Of a frame, or of an estimate, which need not be whole.
std::string whole_cycles(double cycles) {
  return std::isfinite(cycles) ? grouped(static_cast<std::uint64_t>(std::llround(cycles))) : "-";
}

void add_levels(const AccuracyResult& result, std::string& text) {
  constexpr auto kLeft = Align::kLeft;
  constexpr auto kRight = Align::kRight;
  TextTable table({kLeft, kRight, kRight, kRight, kRight, kRight, kRight, kRight, kRight, kLeft});
  table.add_row({"level", "processor s", "wall s", "cycles", "error %", "DRAM bytes %", "hit rates",
                 "p_t %", "within %", ""});
  table.add_rule();
  const std::vector<bool> front = pareto_front(result.runs, result.reference);
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const LevelRun& run = result.runs[i];
    table.add_row({run.level.name, fmt::format("{:.3f}", run.processor_seconds),
                   fmt::format("{:.3f}", run.wall_seconds),
                   whole_cycles(run.quantities[kCyclesQuantity].value),
                   percent(run.error(kCyclesQuantity, result.reference)),
                   percent(run.error(kDramBytesQuantity, result.reference)),
                   percent(run.worst_hit_rate_error(result.reference)),
                   percent(run.error(p_t_of(result.reference), result.reference)),
                   fmt::format("{:.3f}", 100.0 * run.reliable_within(result.reference)),
                   front[i] ? "*" : ""});
  }
  text += table.text(2);
  text +=
      "\n  error: of the cycles; hit rates: the worst of all caches, in points; within: the worse "
      "of\n  error and half the confidence interval, in cycles and in DRAM bytes; *: no other "
      "level "
      "is\n  both cheaper and closer. Times: median of up to 3 runs, without scene and tree.\n\n";
}

void add_cheapest(const AccuracyResult& result, std::string& text) {
  for (const double limit : kLimits) {
    const LevelRun* const run = cheapest_within(limit, result.runs, result.reference);
    text += fmt::format("  cheapest within {:.0f} %: {}\n", 100.0 * limit,
                        run != nullptr ? fmt::format("{} ({})", run->level.name,
                                                     fmt::join(run->level.settings, " "))
                                       : "none");
  }
}

void add_images(const AccuracyResult& result, std::string& text) {
  constexpr auto kRight = Align::kRight;
  TextTable table({Align::kLeft, Align::kLeft, kRight, kRight, kRight, kRight});
  table.add_row({"picture", "film", "cycles", "RMSE", "relMSE", "FLIP"});
  table.add_rule();
  for (const ImageError& row : result.images) {
    table.add_row({row.picture, row.film, whole_cycles(row.cycles), fmt::format("{:.3g}", row.rmse),
                   fmt::format("{:.3g}", row.rel_mse), fmt::format("{:.4f}", row.flip)});
  }
  text += "\nImage against the double-precision reference\n\n" + table.text(2);
  text += fmt::format(
      "\n  relMSE: mean of (x - r)^2 / (r^2 + {}); FLIP: mean LDR-FLIP at {:.1f} pixels a "
      "degree.\n",
      kRelMseFloor, 67.0);
}

}  // namespace

std::string accuracy_text(const AccuracyResult& result) {
  std::string text =
      fmt::format("{}: errors against {}\n\n", result.scene, result.reference.level.name);
  add_levels(result, text);
  add_cheapest(result, text);
  if (!result.images.empty()) add_images(result, text);
  if (!result.precision.rows.empty()) text += precision_text(result.precision);
  return text;
}

std::string accuracy_csv(const AccuracyResult& result) {
  std::string csv = "level,settings,reference,processor_seconds,wall_seconds,within,pareto";
  for (const Quantity& quantity : observed_quantities()) {
    csv += fmt::format(",{0},{0}_error,{0}_ci95", quantity.info.name);
  }
  csv += '\n';
  const std::vector<bool> front = pareto_front(result.runs, result.reference);
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const LevelRun& run = result.runs[i];
    csv += fmt::format("{},{},{},{:.6f},{:.6f},{},{}", run.level.name,
                       fmt::join(run.level.settings, " "), result.reference.level.name,
                       run.processor_seconds, run.wall_seconds,
                       number(run.reliable_within(result.reference)), front[i] ? 1 : 0);
    for (std::size_t q = 0; q < run.quantities.size(); ++q) {
      csv += fmt::format(",{},{},{}", number(run.quantities[q].value),
                         number(run.error(q, result.reference)),
                         number(run.uncertainty(q, result.reference)));
    }
    csv += '\n';
  }
  return csv;
}

std::string image_error_csv(const AccuracyResult& result) {
  std::string csv = "picture,film,cycles,rmse,rel_mse,flip\n";
  for (const ImageError& row : result.images) {
    csv += fmt::format("{},{},{},{:.9g},{:.9g},{:.9g}\n", row.picture, row.film, number(row.cycles),
                       row.rmse, row.rel_mse, row.flip);
  }
  return csv;
}

Plot accuracy_plot(const AccuracyResult& result) {
  Plot plot;
  plot.title = fmt::format("{}: what accuracy costs", result.scene);
  plot.x = {"processor time, s", PlotScale::kLog10};
  plot.y = {fmt::format("within, % of {} ({} or less at the bottom)", result.reference.level.name,
                        kLeastPercent),
            PlotScale::kLog10};
  PlotSeries all{"levels", {}, PlotStyle::kMarks};
  PlotSeries best{"Pareto front", {}, PlotStyle::kLineAndMarks};
  const std::vector<bool> front = pareto_front(result.runs, result.reference);
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const LevelRun& run = result.runs[i];
    const double within = std::max(kLeastPercent, 100.0 * run.reliable_within(result.reference));
    (front[i] ? best : all).points.push_back({run.processor_seconds, within, run.level.name});
  }
  std::ranges::sort(best.points, {}, &PlotPoint::x);
  plot.series = {best, all};
  return plot;
}

Plot image_error_plot(const AccuracyResult& result) {
  Plot plot;
  plot.title = fmt::format("{}: what a film format costs", result.scene);
  plot.x = {"length of the frame, million cycles", PlotScale::kLinear};
  plot.y = {"relMSE against double precision", PlotScale::kLog10};
  PlotSeries formats{"film formats", {}, PlotStyle::kMarks};
  for (const ImageError& row : result.images) {
    if (!std::isfinite(row.cycles)) continue;
    formats.points.push_back({row.cycles / 1e6, std::max(kLeastRelMse, row.rel_mse), row.film});
  }
  plot.series = {formats};
  return plot;
}

}  // namespace sheaf
