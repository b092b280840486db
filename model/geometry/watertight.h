// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

#include "geometry/vec.h"

namespace sheaf {

/// The watertight ray/triangle test of Woop, Benthin and Wald, "Watertight Ray/Triangle
/// Intersection", JCGT 2(1), 2013, section 3, without back-face culling. The triangle is moved to
/// the ray's origin and sheared so that the ray becomes the positive z axis; the signs of three 2D
/// edge functions then decide. Two triangles that share an edge compute the very same edge function
/// for it, so no ray can slip between them.
///
/// A difference of two rounded products never has the wrong sign, because rounding is monotone; it
/// can only be zero where the exact one is not, and then doubles, in which products of floats are
/// exact, decide. All of this needs every operation rounded on its own: no fused multiply-add.
struct ShearedTriangle {
  float ax, ay, az;
  float bx, by, bz;
  float cx, cy, cz;
};

/// t in units of the ray's direction; u and v are the weights of the second and third vertex.
struct TriangleHit {
  float t, u, v;
};

/// The part of a ray that the test needs: z is the axis along which the direction is longest.
struct ShearedRay {
  std::size_t x, y, z;  ///< axes; a cyclic permutation
  float origin_x, origin_y, origin_z;
  float shear_x, shear_y, shear_z;  ///< d[x] / d[z], d[y] / d[z], 1 / d[z]

  ShearedRay(const Vec3& origin, const Vec3& direction) {
    const Vec3 length = glm::abs(direction);
    z = length.x >= length.y && length.x >= length.z ? 0 : length.y >= length.z ? 1 : 2;
    x = z == 2 ? 0 : z + 1;
    y = x == 2 ? 0 : x + 1;
    const auto component = [](const Vec3& vec, std::size_t axis) {
      return vec[static_cast<int>(axis)];
    };
    origin_x = component(origin, x);
    origin_y = component(origin, y);
    origin_z = component(origin, z);
    shear_x = component(direction, x) / component(direction, z);
    shear_y = component(direction, y) / component(direction, z);
    shear_z = 1.0F / component(direction, z);
  }
  ShearedRay() = default;

  /// `corners` are the nine coordinates of the triangle's three corners.
  [[nodiscard]] ShearedTriangle shear(const float* corners) const {
    const float az = corners[z] - origin_z;
    const float bz = corners[3 + z] - origin_z;
    const float cz = corners[6 + z] - origin_z;
    return {(corners[x] - origin_x) - shear_x * az,
            (corners[y] - origin_y) - shear_y * az,
            shear_z * az,
            (corners[3 + x] - origin_x) - shear_x * bz,
            (corners[3 + y] - origin_y) - shear_y * bz,
            shear_z * bz,
            (corners[6 + x] - origin_x) - shear_x * cz,
            (corners[6 + y] - origin_y) - shear_y * cz,
            shear_z * cz};
  }
};

/// Decides in double precision whether the sheared triangle contains the z axis. Used where an edge
/// function is zero in single precision. False for triangles without area in the ray's projection.
[[nodiscard]] inline bool hit_in_double(const ShearedTriangle& s, TriangleHit& hit) {
  const double u = double{s.cx} * double{s.by} - double{s.cy} * double{s.bx};
  const double v = double{s.ax} * double{s.cy} - double{s.ay} * double{s.cx};
  const double w = double{s.bx} * double{s.ay} - double{s.by} * double{s.ax};
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return false;
  const double area = (u + v) + w;
  if (area == 0.0) return false;
  hit.t = static_cast<float>(((u * double{s.az} + v * double{s.bz}) + w * double{s.cz}) / area);
  hit.u = static_cast<float>(v / area);
  hit.v = static_cast<float>(w / area);
  return true;
}

/// Whether the line of the ray meets the triangle, and where. The caller checks the range of t;
/// t is NaN if the arithmetic overflowed.
[[nodiscard]] inline bool hit_sheared(const ShearedTriangle& s, TriangleHit& hit) {
  const float u = s.cx * s.by - s.cy * s.bx;
  const float v = s.ax * s.cy - s.ay * s.cx;
  const float w = s.bx * s.ay - s.by * s.ax;
  const float least_uv = u < v ? u : v;
  const float most_uv = u > v ? u : v;
  const float least = least_uv < w ? least_uv : w;
  const float most = most_uv > w ? most_uv : w;
  if (!(least >= 0.0F || most <= 0.0F)) return false;
  if (u == 0.0F || v == 0.0F || w == 0.0F) return hit_in_double(s, hit);
  const float area = (u + v) + w;
  hit.t = ((u * s.az + v * s.bz) + w * s.cz) / area;
  hit.u = v / area;
  hit.v = w / area;
  return true;
}

}  // namespace sheaf
