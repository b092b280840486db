// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/frame.h"

#include "config/check_config.h"

namespace sheaf {
namespace {

std::uint32_t num_pixels(const ImageSpec& image) {
  return image.width * image.height;
}

HeatMaps make_heat_maps(const ImageSpec& image) {
  HeatMaps maps;
  for (const std::string& name : heat_map_names(image)) {
    if (name == "rays") maps.rays.resize(num_pixels(image));
    if (name == "node_visits") maps.node_visits.resize(num_pixels(image));
    if (name == "triangle_tests") maps.triangle_tests.resize(num_pixels(image));
  }
  return maps;
}

}  // namespace

Frame::Frame(const Config& config)
    : film(make_film(config.film.format, num_pixels(config.image))),
      layers(num_pixels(config.image)),
      heat(make_heat_maps(config.image)),
      rays(config.render.recursion_level) {}

}  // namespace sheaf
