// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "shading/dielectric.h"
#include "shading/lighting.h"
#include "shading/ray_offset.h"
#include "shading/saturate.h"
#include "shading/shader.h"

namespace sheaf {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

enum Slot : std::uint32_t { kReflectionSlot = 0, kRefractionSlot = 1, kFirstShadowSlot = 2 };

RayTag child_tag(const Ray& parent, RayKind kind, std::uint32_t slot) {
  return {child_ray_id(parent.tag.id, slot), parent.tag.pixel,
          static_cast<std::uint8_t>(parent.tag.depth + 1), kind};
}

float largest(const Vec3& v) {
  return std::max({v.x, v.y, v.z});
}

/// The reflection of a unit direction about a unit normal, of unit length even if both are not
/// quite: 100 bounces between two mirrors must not stretch it.
Vec3 mirrored(const Vec3& direction, const Vec3& normal) {
  return glm::normalize(direction - 2.0F * glm::dot(direction, normal) * normal);
}

/// The boundary that a ray crosses, as its interpolated normal has it; where that normal is turned
/// away from the ray (at silhouettes), as the geometric normal has it.
struct Boundary {
  Vec3 normal;
  float cos_incident;
  float eta;
  Dielectric fresnel;

  Boundary(const Ray& ray, const Surface& surface) : normal(surface.shading_normal) {
    cos_incident = -glm::dot(ray.direction, normal);
    if (!(cos_incident > 0.0F)) {
      normal = surface.geometric_normal;
      cos_incident = std::max(-glm::dot(ray.direction, normal), 0.0F);
    }
    cos_incident = std::min(cos_incident, 1.0F);
    const float ior = surface.material->ior;
    eta = surface.entering ? 1.0F / ior : ior;
    fresnel = dielectric(cos_incident, eta);
  }

  [[nodiscard]] Vec3 refracted(const Vec3& direction) const {
    if (eta == 1.0F) {
      return direction;
    }
    return glm::normalize(eta * direction + (eta * cos_incident - fresnel.cos_refracted) * normal);
  }
};

}  // namespace

bool Shader::reflect(const Ray& ray, const Surface& surface, Ray& spawned) const {
  const Material& m = *surface.material;
  if (!m.reflects() || ray.tag.depth >= options_.recursion_level) {
    return false;
  }
  Vec3 share = m.mirror_weight * (m.mirror_tinted ? surface.base_color : Vec3(1.0F));
  if (m.transmission > 0.0F) {
    share += m.transmission * Boundary(ray, surface).fresnel.reflectance;
  }
  const Vec3 weight = saturate(ray.weight * share);
  if (!(largest(weight) > options_.weight_cutoff)) {
    return false;
  }
  Vec3 direction = mirrored(ray.direction, surface.shading_normal);
  if (!(glm::dot(direction, surface.geometric_normal) > 0.0F)) {
    direction = mirrored(ray.direction, surface.geometric_normal);
  }
  spawned = {offset_origin(surface.position, surface.geometric_normal, surface.offset), kInfinity,
             direction, weight, child_tag(ray, RayKind::kReflection, kReflectionSlot)};
  return true;
}

bool Shader::refract(const Ray& ray, const Surface& surface, Ray& spawned) const {
  const Material& m = *surface.material;
  if (!m.refracts() || ray.tag.depth >= options_.recursion_level) {
    return false;
  }
  const Boundary boundary(ray, surface);
  // Zero, and so no ray, under total internal reflection.
  const float share = m.transmission * (1.0F - boundary.fresnel.reflectance);
  const Vec3 weight = saturate(ray.weight * (share * surface.base_color));
  if (!(largest(weight) > options_.weight_cutoff)) {
    return false;
  }
  Vec3 direction = boundary.refracted(ray.direction);
  if (!(glm::dot(direction, surface.geometric_normal) < 0.0F)) {
    direction = ray.direction;  // the only way that surely leads through the surface
  }
  spawned = {offset_origin(surface.position, -surface.geometric_normal, surface.offset), kInfinity,
             direction, weight, child_tag(ray, RayKind::kRefraction, kRefractionSlot)};
  return true;
}

bool Shader::shadow(const Ray& ray, const Surface& surface, std::uint32_t light,
                    Ray& spawned) const {
  const Material& m = *surface.material;
  if (!m.diffuse()) {
    return false;
  }
  const Light& source = scene_.lights[light];
  const IncidentLight incident = incident_light(source, surface.position);
  const float cosine = glm::dot(incident.direction, surface.shading_normal);
  if (!(cosine > 0.0F && glm::dot(incident.direction, surface.geometric_normal) > 0.0F)) {
    return false;
  }
  // The small factors first, so that bright lights and short distances do not overflow in between.
  const Vec3 reflected =
      ray.weight * surface.base_color * (m.diffuse_weight * std::numbers::inv_pi_v<float> * cosine);
  const Vec3 weight =
      saturate(reflected * incident.attenuation * source.intensity * incident.attenuation_2);
  if (!(largest(weight) > options_.weight_cutoff)) {
    return false;
  }
  spawned = {offset_origin(surface.position, surface.geometric_normal, surface.offset), kInfinity,
             incident.direction, weight,
             child_tag(ray, RayKind::kShadow, kFirstShadowSlot + light)};
  if (source.type != Light::Type::kDirectional) {
    // Aimed anew from the offset origin, so that the ray ends in the light.
    const Vec3 to_light = source.position - spawned.origin;
    const float distance = glm::length(to_light);
    if (!(distance > 0.0F)) {
      return false;
    }
    spawned.direction = to_light / distance;
    spawned.t_max = distance;
  }
  return true;
}

}  // namespace sheaf
