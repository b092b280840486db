// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/exact.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

namespace sheaf::stability {
namespace {

using Integer = boost::multiprecision::cpp_int;
using Vector = std::array<Integer, 3>;

/// x · 2^149, which is whole for every finite float.
Integer whole(float x) {
  int exponent = 0;
  const double mantissa = std::frexp(double{x}, &exponent);  // x = mantissa · 2^exponent
  Integer result = static_cast<std::int64_t>(std::ldexp(mantissa, 24));
  const int shift = exponent - 24 + 149;
  return shift >= 0 ? Integer(result << shift) : Integer(result / (Integer(1) << -shift));
}

Vector whole(const Vec3& v) {
  return {whole(v.x), whole(v.y), whole(v.z)};
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Integer dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// mantissa · 2^exponent with a mantissa that fits a double; the conversion drops what lies beyond
/// 64 bits.
struct Scaled {
  double mantissa = 0.0;
  int exponent = 0;
};
Scaled scaled(const Integer& x) {
  if (x == 0) return {};
  const Integer size = x < 0 ? Integer(-x) : x;
  const auto bits = static_cast<int>(msb(size)) + 1;
  const int shift = bits > 64 ? bits - 64 : 0;
  const auto top = static_cast<std::uint64_t>(Integer(size >> shift));
  const auto magnitude = static_cast<double>(top);
  return {x < 0 ? -magnitude : magnitude, shift};
}
double ratio(const Integer& numerator, const Integer& denominator) {
  const Scaled n = scaled(numerator);
  const Scaled d = scaled(denominator);
  return std::ldexp(n.mantissa / d.mantissa, n.exponent - d.exponent);
}

/// A positive x · 2^149 to so many bits, and to no less than 2^least: to nearest, ties to even.
Integer rounded(const Integer& x, int bits, int least) {
  if (x == 0) return x;
  const int shift = std::max(static_cast<int>(msb(x)) + 1 - bits, least + 149);
  if (shift <= 0) return x;
  Integer quotient = x >> shift;
  const Integer twice_the_rest = (x - (quotient << shift)) << 1;
  const Integer step = Integer(1) << shift;
  if (twice_the_rest > step || (twice_the_rest == step && (quotient & 1) != 0)) ++quotient;
  return quotient << shift;
}

}  // namespace

// With corners relative to the origin, twice the area that the sheared edge from P to Q spans with
// the axis is d · (P × Q) / d_z, and its length is |(P - Q) - d (P - Q)_z / d_z| in x and y. Of the
// integers, the former's numerator counts 2^-447 and the latter's 2^-298.
ExactHit hit_exactly(const TriangleRecord& triangle, const Ray& ray) {
  const Vec3 length = glm::abs(ray.direction);
  const std::size_t z = length.x >= length.y && length.x >= length.z ? 0
                        : length.y >= length.z                       ? 1
                                                                     : 2;
  const std::size_t x = (z + 1) % 3;
  const std::size_t y = (z + 2) % 3;
  const Vector d = whole(ray.direction);
  const Vector o = whole(ray.origin);
  const std::array<Vector, 3> corners = {whole(triangle.a) - o, whole(triangle.b) - o,
                                         whole(triangle.c) - o};
  std::array<Integer, 3> volume;
  Integer area = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    volume[i] = dot(d, cross(corners[(i + 1) % 3], corners[(i + 2) % 3]));
    area += volume[i];
  }
  ExactHit hit;
  hit.margin = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector e = corners[(i + 1) % 3] - corners[(i + 2) % 3];
    // Both times d_z, as the volume is.
    const Integer ex = e[x] * d[z] - d[x] * e[z];
    const Integer ey = e[y] * d[z] - d[y] * e[z];
    if (ex == 0 && ey == 0) continue;
    const Integer squared = ex * ex + ey * ey;
    const double size = std::ldexp(std::sqrt(ratio(volume[i] * volume[i], squared)), -149);
    const bool inside = (volume[i] < 0) == (area < 0) || volume[i] == 0;
    hit.margin = std::min(hit.margin, inside ? size : -size);
  }
  const Vector normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const Integer along = dot(d, normal);
  hit.t =
      along == 0 ? std::numeric_limits<double>::infinity() : ratio(dot(corners[0], normal), along);
  return hit;
}

bool are_coplanar(const TriangleRecord& a, const TriangleRecord& b) {
  const Vector origin = whole(a.a);
  const Vector normal = cross(whole(a.b) - origin, whole(a.c) - origin);
  const auto in_plane = [&](const Vec3& p) { return dot(normal, whole(p) - origin) == 0; };
  return in_plane(b.a) && in_plane(b.b) && in_plane(b.c);
}

double sum_exactly(std::span<const float> terms) {
  Integer sum = 0;
  for (const float term : terms) sum += whole(term);
  return std::ldexp(ratio(sum, 1), -149);
}

std::vector<float> sums_by_definition(FilmFormat format, std::span<const float> terms) {
  std::vector<float> sums;
  if (format == FilmFormat::kUnorm8) {
    Integer stored = 0;  // in steps of 1/255
    for (const float term : terms) {
      const Integer steps = (stored << 149) + 255 * whole(term);
      stored = std::min<Integer>((steps + (Integer(1) << 148)) >> 149, 255);
      sums.push_back(static_cast<float>(stored) / 255.0F);
    }
    return sums;
  }
  const bool half = format == FilmFormat::kHalf;
  const Integer largest = whole(half ? 65504.0F : std::numeric_limits<float>::max());
  Integer stored = 0;
  for (const float term : terms) {
    const Integer sum = std::min<Integer>(stored + whole(term), largest);
    stored = half ? rounded(sum, 11, -24) : rounded(sum, 24, -149);
    sums.push_back(static_cast<float>(std::ldexp(ratio(stored, 1), -149)));
  }
  return sums;
}

bool contains_axis(const ShearedTriangle& triangle) {
  const auto edge = [](float px, float py, float qx, float qy) -> Integer {
    return whole(px) * whole(qy) - whole(py) * whole(qx);
  };
  const Integer u = edge(triangle.cx, triangle.cy, triangle.bx, triangle.by);
  const Integer v = edge(triangle.ax, triangle.ay, triangle.cx, triangle.cy);
  const Integer w = edge(triangle.bx, triangle.by, triangle.ax, triangle.ay);
  const bool some_negative = u < 0 || v < 0 || w < 0;
  const bool some_positive = u > 0 || v > 0 || w > 0;
  return some_negative != some_positive;
}

}  // namespace sheaf::stability
