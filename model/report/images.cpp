// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/images.h"

#include "config/config_text.h"
#include "image/exr.h"
#include "image/png.h"

namespace sheaf {
namespace {

/// EXR channels with the planes that they point to.
class Layers {
 public:
  explicit Layers(std::size_t num_pixels) : num_pixels_(num_pixels) {}

  void add(const std::string& name, std::vector<float> plane) {
    planes_.push_back({name, std::move(plane)});
  }
  void add_vectors(const std::string& prefix, const std::string& components,
                   const std::vector<Vec3>& values) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<float> plane(num_pixels_);
      for (std::size_t i = 0; i < num_pixels_; ++i) plane[i] = values[i][axis];
      add(prefix + components[static_cast<std::size_t>(axis)], std::move(plane));
    }
  }
  [[nodiscard]] std::vector<ExrChannel> channels() const {
    std::vector<ExrChannel> channels;
    for (const auto& [name, plane] : planes_) channels.push_back({name, plane});
    return channels;
  }

 private:
  struct Plane {
    std::string name;
    std::vector<float> values;
  };
  std::size_t num_pixels_;
  std::vector<Plane> planes_;
};

std::vector<float> to_float(const std::vector<std::uint32_t>& counts) {
  return {counts.begin(), counts.end()};
}

}  // namespace

void write_images(const Config& config, const Frame& frame, ResultFolder& folder) {
  const std::uint32_t width = config.image.width;
  const std::uint32_t height = config.image.height;
  const std::size_t num_pixels = std::size_t{width} * height;
  std::vector<Vec3> beauty(num_pixels);
  for (std::uint32_t i = 0; i < num_pixels; ++i) beauty[i] = frame.film->value(i);
  write_png(folder.stage("image.png"), width, height, beauty);

  Layers layers(num_pixels);
  layers.add_vectors("", "RGB", beauty);
  layers.add("A", std::vector<float>(num_pixels, 1.0F));
  layers.add_vectors("albedo.", "RGB", frame.layers.albedo);
  layers.add_vectors("normal.", "XYZ", frame.layers.normal);
  layers.add("depth.Z", frame.layers.depth);
  const auto heat = [&](const std::string& name, const std::vector<std::uint32_t>& counts) {
    if (counts.empty()) return;
    const std::vector<float> values = to_float(counts);
    write_heat_map_png(folder.stage("heat_" + name + ".png"), width, height, values);
    layers.add("heat." + name + ".Y", values);
  };
  heat("rays", frame.heat.rays);
  heat("node_visits", frame.heat.node_visits);
  heat("triangle_tests", frame.heat.triangle_tests);
  const std::vector<ExrAttribute> attributes{{"sheaf.version", SHEAF_VERSION},
                                             {"sheaf.config_hash", config_hash(config)}};
  write_exr(folder.stage("image.exr"), width, height, layers.channels(), attributes);
}

}  // namespace sheaf
