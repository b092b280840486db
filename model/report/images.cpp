// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/images.h"

#include <algorithm>
#include <string>
#include <vector>

#include "config/config_text.h"
#include "image/exr.h"
#include "image/png.h"

namespace sheaf {
namespace {

/// The rows of one component of an image of vectors.
RowSource<float> component(const RowSource<Vec3>& vectors, int axis, std::uint32_t width) {
  return [vectors, axis, pixels = std::vector<Vec3>(width)](std::uint32_t y,
                                                            std::span<float> row) mutable {
    vectors(y, pixels);
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = pixels[x][axis];
  };
}

/// The rows of something that holds a value a pixel.
template <typename T, typename Pixels>
RowSource<T> rows_in(const Pixels& pixels) {
  return [&pixels](std::uint32_t y, std::span<T> row) {
    const std::size_t first = std::size_t{y} * row.size();
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = static_cast<T>(pixels[first + x]);
  };
}

RowSource<Vec3> rows_in_film(const Film& film) {
  return [&film](std::uint32_t y, std::span<Vec3> row) {
    const auto first = static_cast<std::uint32_t>(y * row.size());
    for (std::uint32_t x = 0; x < row.size(); ++x) row[x] = film.value(first + x);
  };
}

}  // namespace

void write_images(const Config& config, const Frame& frame, ResultFolder& folder) {
  const std::uint32_t width = config.image.width;
  const std::uint32_t height = config.image.height;
  const RowSource<Vec3> beauty = rows_in_film(*frame.film);
  write_png(folder.stage("image.png"), width, height, beauty);

  std::vector<ExrChannel> channels;
  const auto add_vectors = [&](const std::string& prefix, const std::string& components,
                               const RowSource<Vec3>& vectors) {
    for (int axis = 0; axis < 3; ++axis) {
      channels.push_back(
          {prefix + components[static_cast<std::size_t>(axis)], component(vectors, axis, width)});
    }
  };
  add_vectors("", "RGB", beauty);
  channels.push_back({"A", [](std::uint32_t /*y*/, std::span<float> row) {
                        std::fill(row.begin(), row.end(), 1.0F);
                      }});
  add_vectors("albedo.", "RGB", rows_in<Vec3>(frame.layers.albedo));
  add_vectors("normal.", "XYZ", rows_in<Vec3>(frame.layers.normal));
  channels.push_back({"depth.Z", rows_in<float>(frame.layers.depth)});
  const auto heat = [&](const std::string& name, const std::vector<std::uint32_t>& counts) {
    if (counts.empty()) return;
    const RowSource<float> rows = rows_in<float>(counts);
    write_heat_map_png(folder.stage("heat_" + name + ".png"), width, height, rows);
    channels.push_back({"heat." + name + ".Y", rows});
  };
  heat("rays", frame.heat.rays);
  heat("node_visits", frame.heat.node_visits);
  heat("triangle_tests", frame.heat.triangle_tests);
  const std::vector<ExrAttribute> attributes{{"sheaf.version", SHEAF_VERSION},
                                             {"sheaf.config_hash", config_hash(config)}};
  write_exr(folder.stage("image.exr"), width, height, channels, attributes);
}

}  // namespace sheaf
