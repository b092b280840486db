// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/camera.h"

#include <limits>

namespace sheaf {

Ray primary_ray(const Camera& camera, std::uint32_t width, std::uint32_t height, std::uint32_t x,
                std::uint32_t y) {
  // Position on the picture plane, in double so that neighbouring pixels of a large picture differ.
  const double half = camera.half_height;
  const double right = ((x + 0.5) / width * 2.0 - 1.0) * half * width / height;
  const double up = (1.0 - (y + 0.5) / height * 2.0) * half;
  const Vec3d offset = right * Vec3d(camera.right) + up * Vec3d(camera.up);
  Ray ray;
  if (camera.orthographic) {
    ray.origin = Vec3(Vec3d(camera.position) + offset);
    ray.direction = camera.forward;
  } else {
    ray.origin = camera.position;
    ray.direction = Vec3(glm::normalize(Vec3d(camera.forward) + offset));
  }
  ray.t_max = std::numeric_limits<float>::infinity();
  ray.weight = Vec3(1.0F);
  ray.tag.pixel = y * width + x;
  ray.tag.id = primary_ray_id(ray.tag.pixel);
  return ray;
}

}  // namespace sheaf
