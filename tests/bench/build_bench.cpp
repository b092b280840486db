// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// How long kd-trees take to build, and how that grows with the number of triangles. Prints tables
// in Markdown and writes the plot.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "bench/medians.h"
#include "image/file_output.h"
#include "kdtree/build.h"
#include "report/plot.h"
#include "scene/load_gltf.h"
#include "support/kd_stats.h"

namespace sheaf::bench {
namespace {

struct Mesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A ball with waves on it, of 4 side^2 triangles.
Mesh wavy_ball(std::uint32_t side) {
  constexpr float kPi = std::numbers::pi_v<float>;
  Mesh mesh;
  const std::uint32_t columns = 2 * side;
  for (std::uint32_t row = 0; row <= side; ++row) {
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const float theta = kPi * static_cast<float>(row) / static_cast<float>(side);
      const float phi = 2.0F * kPi * static_cast<float>(column) / static_cast<float>(columns);
      const float radius = 1.0F + 0.1F * std::sin(9.0F * theta) * std::sin(8.0F * phi);
      mesh.positions.push_back(radius * Vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                             std::sin(theta) * std::sin(phi)));
    }
  }
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = row * (columns + 1) + column;
      const std::uint32_t b = a + columns + 1;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({a + 1, b, b + 1});
    }
  }
  return mesh;
}

template <typename Triangles>
double build_seconds(const std::vector<Vec3>& positions, const Triangles& triangles,
                     unsigned threads) {
  KdBuildOptions options;
  options.threads = threads;
  const double start = wall_seconds();
  const KdTree tree = build_kd_tree(positions, triangles, options);
  return wall_seconds() - start;
}

void measure_scene(const std::string& path, int repeats) {
  const Scene scene = load_scene(path).scene;
  std::vector<double> one;
  std::vector<double> two;
  for (int i = 0; i < repeats; ++i) {
    one.push_back(build_seconds(scene.positions, scene.triangles, 1));
    two.push_back(build_seconds(scene.positions, scene.triangles, 2));
  }
  fmt::print("| {} | {} | {:.2f} | {:.2f} |\n", std::filesystem::path(path).filename().string(),
             scene.triangles.size(), median(one), median(two));
  std::fflush(stdout);
}

void measure_growth(const std::string& plot_path, double most_triangles) {
  fmt::print("\n| triangles | seconds, one thread | ns / (N log2 N) |\n| --- | --- | --- |\n");
  std::vector<PlotPoint> measured;
  for (const std::uint32_t side : {50U, 158U, 500U, 1581U}) {
    if (4.0 * side * side > most_triangles) break;
    const Mesh mesh = wavy_ball(side);
    const auto count = static_cast<double>(mesh.triangles.size());
    std::vector<double> seconds;
    const int repeats = side <= 158 ? 5 : 1;
    for (int i = 0; i < repeats; ++i) {
      seconds.push_back(build_seconds(mesh.positions, mesh.triangles, 1));
    }
    measured.push_back({count, median(seconds)});
    fmt::print("| {:.0f} | {:.3f} | {:.2f} |\n", count, median(seconds),
               1e9 * median(seconds) / (count * std::log2(count)));
    std::fflush(stdout);
  }
  std::vector<PlotPoint> law;
  const auto n_log_n = [](double n) { return n * std::log2(n); };
  for (const PlotPoint& point : measured) {
    law.push_back({point.x, measured[0].y * n_log_n(point.x) / n_log_n(measured[0].x)});
  }
  const Plot plot{.title = "Building a kd-tree",
                  .x = {"triangles", PlotScale::kLog10},
                  .y = {"seconds", PlotScale::kLog10},
                  .series = {{"measured, one thread", measured, PlotStyle::kLineAndMarks},
                             {"N log N through the first", law, PlotStyle::kLine}}};
  FileOutput file(plot_path);
  file.write(plot_svg(plot));
  file.close();
}

int run(int argc, char** argv) {
  CLI::App app("Seconds to build kd-trees");
  std::vector<std::string> scenes;
  std::string plot = "kdtree_growth.svg";
  int repeats = 5;
  app.add_option("SCENE", scenes, "glTF files")->required();
  app.add_option("--plot", plot, "Where the plot of the growth goes");
  double most_triangles = 1e8;
  app.add_option("--most", most_triangles, "No mesh of more triangles");
  app.add_option("--repeats", repeats, "Builds of each scene; the median counts");
  CLI11_PARSE(app, argc, argv);
  fmt::print("| scene | triangles | seconds, one thread | two threads |\n");
  fmt::print("| --- | --- | --- | --- |\n");
  for (const std::string& scene : scenes) measure_scene(scene, repeats);
  measure_growth(plot, most_triangles);
  return 0;
}

}  // namespace
}  // namespace sheaf::bench

int main(int argc, char** argv) {
  return sheaf::bench::run(argc, argv);
}
