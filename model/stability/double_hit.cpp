// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/double_hit.h"

#include <algorithm>
#include <cmath>

#include "stability/catalogue.h"  // gamma()

namespace sheaf::stability {
namespace {

constexpr double kHalfUlp = 0x1p-24;

/// The triangle as the ray sees it: relative to the origin and sheared, so that the ray is the z
/// axis and z is t.
struct Seen {
  Vec3d corners[3];
  double edges[3]{};   ///< the edge function of the edge across from each corner
  double area = 0.0;   ///< twice the area in x and y: their sum
  double size = 0.0;   ///< the largest |x| or |y|
  double reach = 0.0;  ///< the largest max(|x|, |y|) + |z| before the shear
};

Seen see(const TriangleRecord& triangle, const Ray& ray) {
  const Vec3d direction(ray.direction);
  const Vec3d length = glm::abs(direction);
  const int z = length.x >= length.y && length.x >= length.z ? 0 : length.y >= length.z ? 1 : 2;
  const int x = (z + 1) % 3;
  const int y = (z + 2) % 3;
  Seen seen{{Vec3d(triangle.a), Vec3d(triangle.b), Vec3d(triangle.c)}};
  for (Vec3d& corner : seen.corners) {
    const Vec3d to = corner - Vec3d(ray.origin);
    seen.reach = std::max(seen.reach, std::max(std::abs(to[x]), std::abs(to[y])) + std::abs(to[z]));
    const double t = to[z] / direction[z];
    corner = Vec3d(to[x] - direction[x] * t, to[y] - direction[y] * t, t);
    seen.size = std::max({seen.size, std::abs(corner.x), std::abs(corner.y)});
  }
  for (int i = 0; i < 3; ++i) {
    const Vec3d& p = seen.corners[(i + 1) % 3];
    const Vec3d& q = seen.corners[(i + 2) % 3];
    seen.edges[i] = p.x * q.y - p.y * q.x;
    seen.area += seen.edges[i];
  }
  return seen;
}

double margin_of(const Seen& seen) {
  double margin = INFINITY;
  for (int i = 0; i < 3; ++i) {
    const Vec3d& p = seen.corners[(i + 1) % 3];
    const Vec3d& q = seen.corners[(i + 2) % 3];
    margin = std::min(margin, std::copysign(1.0, seen.area) * seen.edges[i] /
                                  std::max(std::hypot(p.x - q.x, p.y - q.y), 1e-300));
  }
  return margin;
}

/// How far t may be off if corners may be moved by `moved` in x and y. Three things add up.
double t_error_of(const Seen& seen, double moved) {
  const Vec3d& a = seen.corners[0];
  const Vec3d e1 = seen.corners[1] - a;
  const Vec3d e2 = seen.corners[2] - a;
  // The moved triangle has at the axis the t which the triangle itself has no farther than `moved`
  // from there.
  const double slope =
      std::hypot(e1.z * e2.x - e2.z * e1.x, e1.z * e2.y - e2.z * e1.y) / std::abs(seen.area);
  // Each edge function has two products and their difference, each product at most size² and the
  // difference 2 size²: 4 u size². With edge functions off by d in sum, weights are off by
  // 2 d / area in sum, and their mean t by half of that times the range of t; never by more than
  // the range.
  const double size = seen.size + moved;
  const double base = std::hypot(e1.x, e1.y) + std::hypot(e2.x, e2.y);
  const double least_area = std::abs(seen.area) - 2.0 * moved * (base + 2.0 * moved);
  const double of_weights =
      least_area > 0.0 ? std::min(3.0 * 4.0 * kHalfUlp * size * size / least_area, 1.0) : 1.0;
  const auto [low, high] = std::minmax({a.z, seen.corners[1].z, seen.corners[2].z});
  // Nine roundings: of each corner's t three (difference, 1 / d and product), then product, two
  // sums, the two sums of the area, and the quotient.
  return slope * moved + of_weights * (high - low) +
         gamma(9) * std::max(std::abs(low), std::abs(high));
}

}  // namespace

DoubleHit hit_in_doubles(const TriangleRecord& triangle, const Ray& ray) {
  const Seen seen = see(triangle, ray);
  DoubleHit hit;
  hit.margin = margin_of(seen);
  hit.margin_error = 6.0 * kHalfUlp * seen.reach;
  for (int i = 0; i < 3; ++i) hit.t += seen.edges[i] / seen.area * seen.corners[i].z;
  hit.t_error = t_error_of(seen, hit.margin_error);
  return hit;
}

bool explains(const MeshScene& scene, const Ray& ray, const Hit& hit, double t_slack) {
  auto until = double{ray.t_max};
  if (hit.triangle != kNoHit) {
    const DoubleHit own = hit_in_doubles(scene.records[hit.triangle], ray);
    if (own.margin < -own.margin_error) return false;
    if (std::abs(own.t - double{hit.t}) > own.t_error + t_slack) return false;
    until = double{hit.t} - t_slack;
  }
  return std::none_of(scene.records.begin(), scene.records.end(), [&](const TriangleRecord& r) {
    const DoubleHit other = hit_in_doubles(r, ray);
    return other.margin > other.margin_error && other.t > other.t_error &&
           other.t + other.t_error < until;
  });
}

}  // namespace sheaf::stability
