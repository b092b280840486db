// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/accuracy/image_error.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <thread>

#include "apps/own_process.h"
#include "apps/simulate_frame.h"
#include "base/helpers.h"
#include "image/compare.h"
#include "image/flip.h"
#include "shading/reference.h"
#include "system/build_plan.h"

namespace sheaf {
namespace {

struct Format {
  FilmFormat format;
  const char* name;
};
constexpr std::array kFormats{
    Format{FilmFormat::kUnorm8, "unorm8"}, Format{FilmFormat::kHalf, "half"},
    Format{FilmFormat::kFloat, "float"}, Format{FilmFormat::kExact, "exact"}};

using Picture = std::vector<Vec3>;

// Rows in turn to each thread: a pixel depends on nothing but itself.
Picture reference_picture(const Config& config, const PreparedScene& scene,
                          const std::function<bool()>& stop) {
  const std::uint32_t width = config.image.width;
  const std::uint32_t height = config.image.height;
  const ReferenceTracer tracer(
      scene.scene, scene.tree,
      {width, height, config.render.recursion_level, config.render.weight_cutoff});
  Picture picture(std::size_t{width} * height);
  std::atomic<std::uint32_t> next_row = 0;
  const auto trace_rows = [&] {
    for (std::uint32_t y = next_row++; y < height && !stop(); y = next_row++) {
      for (std::uint32_t x = 0; x < width; ++x) {
        picture[std::size_t{y} * width + x] = Vec3(tracer.pixel(x, y));
      }
    }
  };
  {
    const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
    const auto helpers = start_helpers(processors - 1, trace_rows);
    trace_rows();
  }
  return picture;
}

// The length of the frame, then the pixels; nothing if it was stopped.
std::vector<double> render(const Config& config, PreparedScene& scene,
                           const std::function<bool()>& stop) {
  scene.memory = map_memory(scene.scene, scene.tree, config);
  const BuildPlan plan = plan_machine(config, scene.scene.needs);
  Frame frame(config);
  StatsTree stats;
  FrameSimulation simulation{config, plan, scene};
  simulation.stop = stop;
  if (!simulate_frame(simulation, frame, stats)) return {};
  std::vector<double> numbers{static_cast<double>(stats.count("system.cycles"))};
  for (std::uint32_t pixel = 0; pixel < config.image.width * config.image.height; ++pixel) {
    const Vec3d value(frame.film->value(pixel));
    numbers.insert(numbers.end(), {value.x, value.y, value.z});
  }
  return numbers;
}

ImageError compare(const std::string& what, const char* film, double cycles, const Picture& picture,
                   const Picture& reference, std::uint32_t width) {
  const ImageDifference difference = compare_images(picture, reference);
  const auto height = static_cast<std::uint32_t>(picture.size() / width);
  return {what,
          film,
          cycles,
          difference.rmse,
          difference.rel_mse,
          ldr_flip(picture, reference, width, height)};
}

ImageError paper_example(const Format& format) {
  constexpr int kRays = 1000;
  const std::unique_ptr<Film> film = make_film(format.format, 1);
  for (int ray = 0; ray < kRays; ++ray) film->add(0, Vec3(0.001F));
  return compare("1000 rays of weight 0.001", format.name, std::numeric_limits<double>::quiet_NaN(),
                 {film->value(0)}, {Vec3(1.0F)}, 1);
}

}  // namespace

std::vector<ImageError> image_errors(const Config& config, PreparedScene& scene,
                                     const std::function<bool()>& stop) {
  const Picture reference = reference_picture(config, scene, stop);
  std::vector<ImageError> errors;
  for (const Format& format : kFormats) {
    Config with_format = config;
    with_format.run.fidelity = Fidelity::kTimed;
    with_format.film.format = format.format;
    const std::vector<double> numbers =
        in_own_process([&] { return render(with_format, scene, stop); }, stop);
    if (numbers.empty() || stop()) return {};
    Picture picture;
    for (std::size_t i = 1; i + 2 < numbers.size(); i += 3) {
      picture.emplace_back(Vec3d(numbers[i], numbers[i + 1], numbers[i + 2]));
    }
    errors.push_back(
        compare("the scene", format.name, numbers[0], picture, reference, config.image.width));
  }
  for (const Format& format : kFormats) errors.push_back(paper_example(format));
  return errors;
}

}  // namespace sheaf
