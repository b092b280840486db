// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/double_hit.h"

#include <algorithm>
#include <cmath>

namespace sheaf::stability {

DoubleHit hit_in_doubles(const TriangleRecord& triangle, const Ray& ray) {
  constexpr double kHalfUlp = 0x1p-24;
  const Vec3d direction(ray.direction);
  const Vec3d length = glm::abs(direction);
  const int z = length.x >= length.y && length.x >= length.z ? 0 : length.y >= length.z ? 1 : 2;
  const int x = (z + 1) % 3;
  const int y = (z + 2) % 3;
  Vec3d corners[3] = {Vec3d(triangle.a), Vec3d(triangle.b), Vec3d(triangle.c)};
  double reach = 0.0;
  double size = 0.0;
  for (Vec3d& corner : corners) {
    const Vec3d to = corner - Vec3d(ray.origin);
    reach = std::max(reach, std::max(std::abs(to[x]), std::abs(to[y])) + std::abs(to[z]));
    const double t = to[z] / direction[z];
    corner = Vec3d(to[x] - direction[x] * t, to[y] - direction[y] * t, t);
    size = std::max({size, std::abs(corner.x), std::abs(corner.y)});
  }
  double edge[3];
  double margin = INFINITY;
  double area = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vec3d& p = corners[(i + 1) % 3];
    const Vec3d& q = corners[(i + 2) % 3];
    edge[i] = p.x * q.y - p.y * q.x;
    area += edge[i];
  }
  double t = 0.0;
  double t_low = INFINITY;
  double t_high = -INFINITY;
  for (int i = 0; i < 3; ++i) {
    const Vec3d& p = corners[(i + 1) % 3];
    const Vec3d& q = corners[(i + 2) % 3];
    margin = std::min(margin, std::copysign(1.0, area) * edge[i] /
                                  std::max(std::hypot(p.x - q.x, p.y - q.y), 1e-300));
    t += edge[i] / area * corners[i].z;
    t_low = std::min(t_low, corners[i].z);
    t_high = std::max(t_high, corners[i].z);
  }
  DoubleHit hit;
  hit.margin = margin;
  hit.t = t;
  hit.margin_error = 6.0 * kHalfUlp * reach;
  // The weights are off by the moved corners and by the rounding of each product, both relative
  // to the area; t itself has about ten roundings.
  const double weight_error =
      (4.0 * size * hit.margin_error + 8.0 * kHalfUlp * size * size) / std::abs(area);
  hit.t_error = weight_error * (t_high - t_low) +
                16.0 * kHalfUlp * std::max(std::abs(t_low), std::abs(t_high));
  return hit;
}

bool explains(const MeshScene& scene, const Ray& ray, const Hit& hit) {
  auto until = double{ray.t_max};
  if (hit.triangle != kNoHit) {
    const DoubleHit own = hit_in_doubles(scene.records[hit.triangle], ray);
    if (own.margin < -own.margin_error) return false;
    if (std::abs(own.t - double{hit.t}) > own.t_error) return false;
    until = double{hit.t};
  }
  return std::none_of(scene.records.begin(), scene.records.end(), [&](const TriangleRecord& r) {
    const DoubleHit other = hit_in_doubles(r, ray);
    return other.margin > other.margin_error && other.t > other.t_error &&
           other.t + other.t_error < until;
  });
}

}  // namespace sheaf::stability
