// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/gltf_value.h"

namespace sheaf::gltf {
namespace {

Vec3 world_position(const glm::dmat4& world, const std::string& place) {
  return {checked_float(world[3].x, place), checked_float(world[3].y, place),
          checked_float(world[3].z, place)};
}

/// A light shines along its node's -z.
Vec3 world_direction(const glm::dmat4& world, const std::string& place) {
  const Vec3d direction = -Vec3d(world[2]);
  const double length = glm::length(direction);
  if (!(length > 0.0) || !std::isfinite(length)) {
    refuse(place, "the light has no direction: its node is scaled to nothing");
  }
  return {direction / length};
}

void read_cone(const tinygltf::SpotLight& spot, const std::string& place, Light& light) {
  if (!(spot.innerConeAngle >= 0.0 && spot.innerConeAngle <= spot.outerConeAngle &&
        spot.outerConeAngle <= std::numbers::pi / 2)) {
    refuse(place + "/spot", fmt::format("cone angles {} and {} are not 0 <= inner <= outer <= pi/2",
                                        spot.innerConeAngle, spot.outerConeAngle));
  }
  light.cos_inner_cone = static_cast<float>(std::cos(spot.innerConeAngle));
  light.cos_outer_cone = static_cast<float>(std::cos(spot.outerConeAngle));
}

Light::Type to_type(const std::string& name, const std::string& place) {
  if (name == "point") return Light::Type::kPoint;
  if (name == "spot") return Light::Type::kSpot;
  if (name == "directional") return Light::Type::kDirectional;
  refuse(place + "/type", fmt::format("\"{}\" is not point, spot or directional", name));
}

Light read_light(const tinygltf::Light& source, const glm::dmat4& world, const std::string& place,
                 const std::string& node_place) {
  Light light;
  light.type = to_type(source.type, place);
  light.position = world_position(world, node_place);
  if (light.type != Light::Type::kPoint) light.direction = world_direction(world, node_place);
  if (light.type == Light::Type::kSpot) read_cone(source.spot, place, light);
  if (!(source.intensity >= 0.0)) refuse(place + "/intensity", "is negative");
  const Vec3 color = vec3_or(source.color, Vec3(1.0F), place + "/color");
  for (int i = 0; i < 3; ++i) {
    light.intensity[i] = checked_float(std::max(0.0F, color[i]) * source.intensity, place);
  }
  if (!(source.range >= 0.0)) refuse(place + "/range", "is negative");
  light.range = checked_float(source.range, place + "/range");
  return light;
}

}  // namespace

std::vector<Light> read_lights(Document& document, const PlacedNodes& placed) {
  std::vector<Light> lights;
  const auto& list = document.model.lights;
  for (const PlacedItem& item : placed.lights) {
    const std::string node_place = fmt::format("/nodes/{}", item.node);
    if (item.item < 0 || static_cast<std::size_t>(item.item) >= list.size()) {
      refuse(node_place, fmt::format("there is no light {}", item.item));
    }
    const std::string place = fmt::format("/extensions/KHR_lights_punctual/lights/{}", item.item);
    const Light light =
        read_light(list[static_cast<std::size_t>(item.item)], item.world, place, node_place);
    if (light.intensity == Vec3(0.0F)) {
      document.warnings.add("a light of no intensity is left out");
    } else {
      lights.push_back(light);
    }
  }
  return lights;
}

}  // namespace sheaf::gltf
