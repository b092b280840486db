// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "shading/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "shading/reference_hit.h"
#include "shading/reference_surface.h"

namespace sheaf {
namespace {

/// The unit, the far and the least step of the offset, by the conventions of OffsetScale
/// (ray_offset.h).
double largest_coordinate(const Scene& scene) {
  double largest = 0.0;
  for (const Vec3& p : {scene.bounds.lo, scene.bounds.hi}) {
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::fabs(double{p[axis]}));
  }
  return largest;
}
double unit_of(const Scene& scene) {
  const double largest = largest_coordinate(scene);
  if (largest >= 0.25) return 1.0;
  return largest > 0.0 ? std::exp2(std::max(std::floor(std::log2(largest)), -100.0))
                       : std::exp2(-100.0);
}
double far_step(const Scene& scene) {
  double extent = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    extent = std::max(extent, double{scene.bounds.hi[axis]} - double{scene.bounds.lo[axis]});
  }
  const double largest = largest_coordinate(scene);
  return largest > 256.0 * extent ? 4.0 * std::ldexp(1.0, std::ilogb(largest) - 23) : 0.0;
}
double least_step(const Scene& scene, std::uint32_t triangle) {
  const auto& corners = scene.triangles[triangle];
  const Vec3d a(scene.positions[corners[0]]);
  double reach = 0.0;
  for (const std::uint32_t corner : {corners[1], corners[2]}) {
    const Vec3d edge = glm::abs(Vec3d(scene.positions[corner]) - a);
    reach = std::max({reach, edge.x, edge.y, edge.z});
  }
  return reach > 64.0 ? reach * 0x1p-20 : 0.0;
}

/// The surface's point moved along n by as much as Wächter and Binder (Ray Tracing Gems 2019,
/// chapter 6) would move it if it were a float, or by the least step, or in far scenes by theirs.
Vec3d moved_off(const ReferenceSurface& s, const Vec3d& n) {
  Vec3d moved = s.position;
  for (int axis = 0; axis < 3; ++axis) {
    if (s.far_offset > 0.0) {
      moved[axis] += s.far_offset * n[axis];
      continue;
    }
    const double p = s.position[axis];
    double step = n[axis] * s.offset_unit / 65536.0;
    if (std::fabs(p) >= s.offset_unit / 32.0) {
      step = std::trunc(256.0 * n[axis]) * std::ldexp(1.0, std::ilogb(p) - 23);
    }
    const double least = s.least_offset * n[axis];
    moved[axis] += std::fabs(step) < std::fabs(least) ? least : step;
  }
  return moved;
}

Vec3d mirrored(const Vec3d& d, const Vec3d& n) {
  return glm::normalize(d - 2.0 * glm::dot(d, n) * n);
}

/// Fresnel reflectance and refracted direction at a dielectric boundary.
struct Crossing {
  double reflectance = 0.0;
  Vec3d refracted{0.0};
};

Crossing cross_boundary(const Vec3d& d, const ReferenceSurface& s) {
  const auto ior = static_cast<double>(s.material->ior);
  if (ior == 1.0) {
    return {0.0, d};
  }
  const bool faces_ray = glm::dot(d, s.shading_normal) < 0.0;
  const Vec3d n = faces_ray ? s.shading_normal : s.geometric_normal;
  const double n1 = s.entering ? 1.0 : ior;
  const double n2 = s.entering ? ior : 1.0;
  const double cos1 = std::clamp(-glm::dot(d, n), 0.0, 1.0);
  const double sin2 = n1 / n2 * std::sqrt(1.0 - cos1 * cos1);
  if (sin2 >= 1.0) {
    return {1.0, Vec3d(0.0)};
  }
  const double cos2 = std::sqrt(1.0 - sin2 * sin2);
  const double rs = (n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2);
  const double rp = (n2 * cos1 - n1 * cos2) / (n2 * cos1 + n1 * cos2);
  const Vec3d along = d + cos1 * n;  // part of d in the surface
  return {(rs * rs + rp * rp) / 2.0, glm::normalize(n1 / n2 * along - cos2 * n)};
}

/// Irradiance that the light would give a surface facing it, and where it comes from.
struct Illumination {
  Vec3d irradiance{0.0};
  Vec3d direction{0.0};
};

Illumination illuminate(const Light& light, const Vec3d& point) {
  const Vec3d intensity(light.intensity);
  if (light.type == Light::Type::kDirectional) {
    return {intensity, -glm::normalize(Vec3d(light.direction))};
  }
  const Vec3d to_light = Vec3d(light.position) - point;
  const double distance = glm::length(to_light);
  if (distance == 0.0) {
    return {};
  }
  const Vec3d direction = to_light / distance;
  double share = 1.0 / (distance * distance);
  if (light.type == Light::Type::kSpot) {
    const auto inner = static_cast<double>(light.cos_inner_cone);
    const auto outer = static_cast<double>(light.cos_outer_cone);
    const double cosine = -glm::dot(Vec3d(light.direction), direction);
    const double ramp = std::clamp((cosine - outer) / std::fmax(0.001, inner - outer), 0.0, 1.0);
    share *= ramp * ramp;
  }
  if (light.range > 0.0F) {
    share *= std::clamp(1.0 - std::pow(distance / static_cast<double>(light.range), 4.0), 0.0, 1.0);
  }
  return {intensity * share, direction};
}

/// One traced path tree. Weights are carried down as in the machine, so that a cutoff cuts alike.
class Tracer {
 public:
  Tracer(const Scene& scene, const KdTree& tree, const ReferenceTracer::Options& options)
      : scene_(scene),
        tree_(tree),
        options_(options),
        offset_unit_(unit_of(scene)),
        far_offset_(far_step(scene)) {}

  [[nodiscard]] Vec3d trace(const ReferenceRay& ray, const Vec3d& weight,
                            std::uint32_t depth) const {
    const auto hit = reference_closest_hit(scene_, tree_, ray);
    if (!hit) {
      return weight * Vec3d(scene_.background);
    }
    ReferenceSurface s = reference_surface(scene_, ray, *hit);
    s.offset_unit = offset_unit_;
    s.far_offset = far_offset_;
    s.least_offset = least_step(scene_, hit->triangle);
    if (s.material->unlit) {
      return weight * s.base_color;
    }
    Vec3d sum = weight * s.emission;
    for (const Light& light : scene_.lights) {
      sum += lit(light, s, weight);
    }
    if (depth < options_.recursion_level) {
      sum += bounced(ray, s, weight, depth + 1);
    }
    return sum;
  }

 private:
  [[nodiscard]] bool worth_tracing(const Vec3d& weight) const {
    return std::max({weight.x, weight.y, weight.z}) > options_.weight_cutoff;
  }

  [[nodiscard]] Vec3d lit(const Light& light, const ReferenceSurface& s,
                          const Vec3d& weight) const {
    const Illumination incoming = illuminate(light, s.position);
    const double cosine = glm::dot(incoming.direction, s.shading_normal);
    if (cosine <= 0.0 || glm::dot(incoming.direction, s.geometric_normal) <= 0.0) {
      return Vec3d(0.0);
    }
    const double share =
        static_cast<double>(s.material->diffuse_weight) * cosine / std::numbers::pi;
    const Vec3d contribution = weight * s.base_color * share * incoming.irradiance;
    if (!worth_tracing(contribution)) {
      return Vec3d(0.0);
    }
    ReferenceRay ray{moved_off(s, s.geometric_normal), incoming.direction};
    if (light.type != Light::Type::kDirectional) {
      const Vec3d to_light = Vec3d(light.position) - ray.origin;
      ray.t_max = glm::length(to_light);
      if (ray.t_max == 0.0) {
        return Vec3d(0.0);
      }
      ray.direction = to_light / ray.t_max;
    }
    return reference_occluded(scene_, tree_, ray) ? Vec3d(0.0) : contribution;
  }

  [[nodiscard]] Vec3d bounced(const ReferenceRay& ray, const ReferenceSurface& s,
                              const Vec3d& weight, std::uint32_t depth) const {
    const Material& m = *s.material;
    const auto transmission = static_cast<double>(m.transmission);
    const Crossing crossing = transmission > 0.0 ? cross_boundary(ray.direction, s) : Crossing{};
    Vec3d sum(0.0);

    const Vec3d mirror =
        static_cast<double>(m.mirror_weight) * (m.mirror_tinted ? s.base_color : Vec3d(1.0));
    const Vec3d reflected = weight * (mirror + transmission * crossing.reflectance);
    if (worth_tracing(reflected)) {
      Vec3d direction = mirrored(ray.direction, s.shading_normal);
      if (glm::dot(direction, s.geometric_normal) <= 0.0) {
        direction = mirrored(ray.direction, s.geometric_normal);
      }
      sum += trace({moved_off(s, s.geometric_normal), direction}, reflected, depth);
    }

    const Vec3d refracted = weight * s.base_color * (transmission * (1.0 - crossing.reflectance));
    if (worth_tracing(refracted)) {
      const bool passes = glm::dot(crossing.refracted, s.geometric_normal) < 0.0;
      const Vec3d direction = passes ? crossing.refracted : ray.direction;
      sum += trace({moved_off(s, -s.geometric_normal), direction}, refracted, depth);
    }
    return sum;
  }

  const Scene& scene_;
  const KdTree& tree_;
  const ReferenceTracer::Options& options_;
  double offset_unit_;
  double far_offset_;
};

}  // namespace

ReferenceTracer::ReferenceTracer(const Scene& scene, const KdTree& tree, const Options& options)
    : scene_(scene), tree_(tree), options_(options) {}

Vec3d ReferenceTracer::pixel(std::uint32_t x, std::uint32_t y) const {
  const Camera& camera = scene_.camera;
  const double width = options_.width;
  const double height = options_.height;
  const auto half_height = static_cast<double>(camera.half_height);
  const double across = (2.0 * (x + 0.5) / width - 1.0) * half_height * width / height;
  const double up = (1.0 - 2.0 * (y + 0.5) / height) * half_height;
  const Vec3d shift = across * Vec3d(camera.right) + up * Vec3d(camera.up);
  const Vec3d position(camera.position);
  const Vec3d forward(camera.forward);
  return camera.orthographic ? radiance(position + shift, glm::normalize(forward))
                             : radiance(position, glm::normalize(forward + shift));
}

Vec3d ReferenceTracer::radiance(const Vec3d& origin, const Vec3d& direction) const {
  return Tracer(scene_, tree_, options_).trace({origin, direction}, Vec3d(1.0), 0);
}

}  // namespace sheaf
