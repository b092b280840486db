// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace sheaf {

/// What happens to light at a smooth boundary between two dielectrics.
struct Dielectric {
  float reflectance = 0.0F;    ///< share of unpolarised light that is reflected; 1 if total
  float cos_refracted = 1.0F;  ///< between the refracted direction and the reversed normal
};

/// Fresnel's equations (Born and Wolf, "Principles of Optics", section 1.5.2) for light that meets
/// the boundary at cos_incident in [0, 1]; eta is the index of refraction on the light's side
/// divided by that on the other side. eta == 1 is no boundary.
[[nodiscard]] inline Dielectric dielectric(float cos_incident, float eta) {
  if (eta == 1.0F) {
    return {0.0F, cos_incident};
  }
  // Snell's law; 1 - c² as (1 - c)(1 + c) does not cancel near normal incidence.
  const float sin2_refracted = eta * eta * (1.0F - cos_incident) * (1.0F + cos_incident);
  if (!(sin2_refracted < 1.0F)) {
    return {1.0F, 0.0F};
  }
  const float cos_refracted = std::sqrt(1.0F - sin2_refracted);
  const float s = (eta * cos_incident - cos_refracted) / (eta * cos_incident + cos_refracted);
  const float p = (cos_incident - eta * cos_refracted) / (cos_incident + eta * cos_refracted);
  return {0.5F * (s * s + p * p), cos_refracted};
}

}  // namespace sheaf
