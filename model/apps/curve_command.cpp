// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/curve_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <bit>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "apps/exit_codes.h"
#include "apps/shared_options.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "report/plot.h"
#include "report/result_folder.h"
#include "report/table.h"
#include "tracefile/miss_curves.h"
#include "tracefile/trace_metadata.h"

namespace sheaf {
namespace {

constexpr std::uint64_t kMaxLine = 65536;
constexpr std::uint64_t kMaxSets = std::uint64_t{1} << 24;

void check_power_of_two(const char* option, std::uint64_t value, std::uint64_t most) {
  if (std::has_single_bit(value) && value <= most) return;
  throw Error(ExitCode::kUsage,
              fmt::format("{} {}: is no power of two from 1 to {}", option, value, most));
}

std::string capacity_text(double bytes) {
  constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  for (; bytes >= 1024 && unit + 1 < std::size(kUnits); ++unit) bytes /= 1024;
  return fmt::format("{:.4g} {}", bytes, kUnits[unit]);
}

std::string shape_text(const MissCurveOfStream& curve) {
  const std::string sets =
      curve.sets == 1 ? "fully associative" : fmt::format("{} sets", curve.sets);
  return fmt::format("{}-byte lines, {}", curve.line, sets);
}

std::string csv_of(const std::vector<MissCurveOfStream>& curves) {
  std::string text = "stream,line,sets,ways,capacity,accesses,misses,miss_ratio\n";
  for (const MissCurveOfStream& curve : curves) {
    for (const MissCurve::Point& point : curve.points) {
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{:.9g}\n", curve.stream,
                     curve.line, curve.sets, point.ways, curve.capacity(point.ways),
                     curve.num_accesses, point.misses, curve.miss_ratio(point.ways));
    }
  }
  return text;
}

/// A curve as a line: the last point below each sixteenth of an octave is enough for the eye.
std::vector<PlotPoint> line_of(const MissCurveOfStream& curve) {
  std::vector<PlotPoint> line;
  double next = 0;
  for (const MissCurve::Point& point : curve.points) {
    if (point.ways == 0) continue;
    const auto capacity = static_cast<double>(curve.capacity(point.ways));
    const bool last = point.ways == curve.points.back().ways;
    if (std::log2(capacity) < next && !last) continue;
    next = std::log2(capacity) + 1.0 / 16;
    line.push_back({capacity, curve.miss_ratio(point.ways)});
  }
  return line;
}

/// All accesses and each kind of data, of the first shape.
Plot plot_of(const std::vector<MissCurveOfStream>& curves, const std::string& scene) {
  Plot plot;
  plot.title = fmt::format("{}: LRU misses by capacity ({})", scene, shape_text(curves[0]));
  plot.x = {"capacity", PlotScale::kLog2, capacity_text};
  plot.y = {"misses per access", PlotScale::kLinear};
  for (const MissCurveOfStream& curve : curves) {
    const bool first_shape = curve.line == curves[0].line && curve.sets == curves[0].sets;
    if (first_shape && curve.stream.find('.') == std::string::npos) {
      plot.series.push_back({curve.stream, line_of(curve)});
    }
  }
  for (const Knee& knee : find_knees(curves[0])) {
    plot.marks.push_back(
        {static_cast<double>(knee.capacity), capacity_text(static_cast<double>(knee.capacity))});
  }
  return plot;
}

std::string summary_of(const std::vector<MissCurveOfStream>& curves, const std::string& scene) {
  std::string text = fmt::format("{}: LRU misses of all capacities\n", scene);
  std::string shape;
  TextTable table({Align::kLeft, Align::kRight, Align::kRight, Align::kLeft});
  for (const MissCurveOfStream& curve : curves) {
    if (shape_text(curve) != shape) {
      shape = shape_text(curve);
      table.add_row({shape, "line accesses", "distinct", "knees: capacity and miss ratio"});
    }
    std::string knees;
    for (const Knee& knee : find_knees(curve)) {
      knees +=
          fmt::format("{}{}: {:.2f} %", knees.empty() ? "" : ", ",
                      capacity_text(static_cast<double>(knee.capacity)), 100 * knee.miss_ratio);
    }
    table.add_row({"  " + curve.stream, grouped(curve.num_accesses),
                   grouped(curve.points.back().misses), knees.empty() ? "none" : knees});
  }
  return text + table.text();
}

}  // namespace

void declare_curve_command(CLI::App& app, CurveOptions& options) {
  CLI::App* curve = app.add_subcommand(
      "curve", "Tell the LRU misses of all cache sizes, in one pass over a memory trace");
  curve->add_option("TRACE", options.trace, "Memory trace that 'sheaf run --record memory' wrote")
      ->required();
  const auto shape = [&](const char* name, auto& values, const char* meaning) {
    curve->add_option(name, values, meaning)->type_name("N")->capture_default_str();
  };
  shape("--line", options.lines, "Line size in bytes; repeatable");
  shape("--sets", options.sets, "Number of sets, 1 = fully associative; repeatable");
  declare_out(*curve, options, "result/curve");
  curve->add_flag("--quiet", options.quiet, "Print no summary");
  curve->footer(
      "Writes curve.csv (every number of ways at which misses change), curve.svg and curve.png. "
      "Streams: all accesses through one cache; each kind of data through a cache of its own; and "
      "those of each recorded cache. A knee is a capacity up to which doubling saves much, and "
      "beyond which little. For example:\n"
      "  sheaf curve result/dragon/memory.trace --line 32 --line 64 --sets 1 --sets 64\n" +
      exit_codes({ExitCode::kTrace, ExitCode::kInterrupted}));
}

int curve_command(const CurveOptions& options) {
  std::vector<CurveShape> shapes;
  for (const std::uint64_t line : options.lines) {
    check_power_of_two("--line", line, kMaxLine);
    for (const std::uint64_t sets : options.sets) {
      check_power_of_two("--sets", sets, kMaxSets);
      shapes.push_back({line, static_cast<std::uint32_t>(sets)});
    }
  }
  catch_interrupts();
  TraceReader reader(options.trace);
  reader.require(TraceKind::kMemory, "a curve");
  reader.verify();
  const TraceMetadata metadata = read_metadata(reader);
  ResultFolder folder(options.out);
  folder.spare(options.trace);
  MemoryAccesses accesses(reader, metadata.memory);
  const auto curves = measure_miss_curves(accesses, metadata.memory, shapes, interrupted);
  if (interrupted()) {
    throw Error(ExitCode::kInterrupted, "stopped before the curves were whole; nothing is written");
  }
  if (curves.empty()) {
    throw Error(ExitCode::kTrace, options.trace.string() + ": holds no accesses to make curves of");
  }
  const auto text_of = [](const std::vector<std::uint8_t>& bytes) {
    return std::string(bytes.begin(), bytes.end());
  };
  const Plot plot = plot_of(curves, metadata.scene_name);
  const std::string summary = summary_of(curves, metadata.scene_name);
  folder.write("curve.csv", csv_of(curves));
  folder.write("curve.svg", text_of(plot_svg(plot)));
  folder.write("curve.png", text_of(plot_png(plot)));
  folder.write("summary.txt", summary);
  folder.commit();
  if (!options.quiet) {
    std::fputs(summary.c_str(), stdout);
    std::fputs(fmt::format("Results: {}\n", folder.path().string()).c_str(), stdout);
  }
  return static_cast<int>(ExitCode::kOk);
}

}  // namespace sheaf
