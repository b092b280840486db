// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_camera.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/text.h"
#include "scene/camera_setup.h"
#include "scene/gltf_value.h"

namespace sheaf::gltf {
namespace {

void read_lens(const tinygltf::Camera& source, const std::string& place, Camera& camera) {
  if (source.type == "orthographic") {
    camera.orthographic = true;
    const double height = std::abs(source.orthographic.ymag);
    camera.half_height = checked_float(height, place + "/orthographic/ymag");
    if (!(camera.half_height > 0.0F)) refuse(place + "/orthographic/ymag", "is zero");
    return;
  }
  const double yfov = source.perspective.yfov;
  if (!(yfov > 0.0 && yfov < std::numbers::pi)) {
    refuse(place + "/perspective/yfov", fmt::format("{} is not in (0, pi)", yfov));
  }
  camera.half_height = static_cast<float>(std::tan(yfov / 2));
}

Camera read_camera(const tinygltf::Camera& source, const glm::dmat4& world,
                   const std::string& place, const std::string& node_place) {
  const Vec3d position(world[3]);
  const Vec3d forward = -Vec3d(world[2]);
  const double length = glm::length(forward);
  if (!(length > 0.0) || !std::isfinite(length)) {
    refuse(node_place, "the camera has no direction: its node is scaled to nothing");
  }
  for (int i = 0; i < 3; ++i) (void)checked_float(position[i], node_place);
  Camera camera = look_along(position, forward / length, Vec3d(world[1]));
  read_lens(source, place, camera);
  return camera;
}

}  // namespace

std::vector<NamedCamera> read_cameras(const Document& document, const PlacedNodes& placed) {
  std::vector<NamedCamera> cameras;
  const auto& list = document.model.cameras;
  for (const PlacedItem& item : placed.cameras) {
    const std::string node_place = fmt::format("/nodes/{}", item.node);
    if (static_cast<std::size_t>(item.item) >= list.size()) {
      refuse(node_place, fmt::format("there is no camera {}", item.item));
    }
    const tinygltf::Camera& source = list[static_cast<std::size_t>(item.item)];
    const std::string place = fmt::format("/cameras/{}", item.item);
    NamedCamera named;
    named.own_name = printable(source.name, 80);
    named.name = printable(document.model.nodes[static_cast<std::size_t>(item.node)].name, 80);
    if (named.name.empty()) named.name = named.own_name;
    named.camera = read_camera(source, item.world, place, node_place);
    cameras.push_back(std::move(named));
  }
  return cameras;
}

}  // namespace sheaf::gltf
