// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/scene.h"

namespace sheaf {

/// Light as it arrives at a point, unless something is in between.
struct IncidentLight {
  Vec3 direction{0.0F};  ///< unit, from the point towards the light
  float attenuation =
      0;  ///< light.intensity × attenuation × attenuation_2 is the irradiance of a …
  float attenuation_2 = 0;  ///< … surface that faces the light; apart, since 1/d² may leave a float
};

/// Attenuation of a spot light towards cos_angle off its axis: 1 within the inner cone, 0 outside
/// the outer one (KHR_lights_punctual, "Inner and Outer Cone Angles", the reference code there).
[[nodiscard]] inline float spot_attenuation(const Light& light, float cos_angle) {
  const float scale = 1.0F / std::max(0.001F, light.cos_inner_cone - light.cos_outer_cone);
  const float linear = std::clamp((cos_angle - light.cos_outer_cone) * scale, 0.0F, 1.0F);
  return linear * linear;
}

/// Window that brings a light to zero at its range (KHR_lights_punctual, "Range Property").
[[nodiscard]] inline float range_window(const Light& light, float distance) {
  if (!(light.range > 0.0F)) {
    return 1.0F;
  }
  const float relative = distance / light.range;
  const float squared = relative * relative;
  return std::clamp(1.0F - squared * squared, 0.0F, 1.0F);
}

/// Light that arrives at `point`. Its attenuation is 0 where none does: outside the cone or the
/// range, and at a distance whose square is no normal float (below 1e-19, or beyond 1e19).
[[nodiscard]] inline IncidentLight incident_light(const Light& light, const Vec3& point) {
  if (light.type == Light::Type::kDirectional) {
    return {-light.direction, 1.0F, 1.0F};
  }
  const Vec3 to_light = light.position - point;
  const float squared = glm::dot(to_light, to_light);
  if (!std::isnormal(squared)) {
    return {};
  }
  const float inverse = 1.0F / std::sqrt(squared);
  IncidentLight incident{to_light * inverse, inverse, inverse};
  if (light.type == Light::Type::kSpot) {
    incident.attenuation *= spot_attenuation(light, -glm::dot(light.direction, incident.direction));
  }
  incident.attenuation *= range_window(light, squared * inverse);
  return incident;
}

}  // namespace sheaf
