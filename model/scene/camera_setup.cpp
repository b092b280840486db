// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/camera_setup.h"

#include <cmath>

namespace sheaf {
namespace {

/// From the scene's centre to the camera of a framed scene: right, above and in front, so that
/// three sides of a box are seen at different angles.
const Vec3d kThreeQuarter = glm::normalize(Vec3d(0.7, 0.45, 1.0));

/// Sine of the angle below which `up` is too close to `forward` to tell which way is right.
constexpr double kParallel = 1e-6;

Vec3d center(const Box& box) {
  return (Vec3d(box.lo) + Vec3d(box.hi)) * 0.5;
}

}  // namespace

Camera look_along(const Vec3d& position, const Vec3d& forward, const Vec3d& up) {
  Vec3d right = glm::cross(forward, up);
  if (!(glm::length(right) > kParallel * glm::length(up)) || !std::isfinite(glm::length(right))) {
    right = glm::cross(forward,
                       std::abs(forward.y) < 0.9 ? Vec3d(0.0, 1.0, 0.0) : Vec3d(0.0, 0.0, -1.0));
  }
  right = glm::normalize(right);
  Camera camera;
  camera.position = Vec3(position);
  camera.right = Vec3(right);
  camera.up = Vec3(glm::cross(right, forward));
  camera.forward = Vec3(forward);
  return camera;
}

Camera look_at(const Vec3& position, const Vec3& target) {
  const Vec3d way = Vec3d(target) - Vec3d(position);
  const double length = glm::length(way);
  const Vec3d forward = length > 0.0 ? way / length : Vec3d(0.0, 0.0, -1.0);
  return look_along(Vec3d(position), forward, Vec3d(0.0, 1.0, 0.0));
}

Camera frame_box(const Box& box) {
  const double radius = glm::length(Vec3d(box.hi) - Vec3d(box.lo)) * 0.5;
  const double half_angle = std::atan(double{Camera().half_height});
  const double distance = radius > 0.0 ? radius / std::sin(half_angle) : 1.0;
  return look_along(center(box) + distance * kThreeQuarter, -kThreeQuarter, Vec3d(0.0, 1.0, 0.0));
}

}  // namespace sheaf
