// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/clip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sheaf {
namespace {

// A clipped point is an interpolation of two others, each step of which adds an error of at most
// 4 · 2^-53 of the largest coordinate; seven steps (six faces and the split plane) stay below
// 2^-48. Planes are moved outward and computed points are widened by twice that.
constexpr double kRelativeSlack = 0x1p-47;

struct Vertex {
  std::array<double, 3> p;
  double slack;  // bound of the error: 0 for a corner of the triangle
};

// A triangle cut by six planes has at most nine corners. Filled as far as it is read.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
struct Polygon {
  std::array<Vertex, 10> v;
  std::size_t n = 0;
};

Vertex interpolate(const Vertex& a, const Vertex& b, double t, double slack) {
  return {{a.p[0] + t * (b.p[0] - a.p[0]), a.p[1] + t * (b.p[1] - a.p[1]),
           a.p[2] + t * (b.p[2] - a.p[2])},
          slack};
}

// Keeps what is at or above the limit (kAbove) or at or below it.
template <bool kAbove>
void clip_at(const Polygon& in, Polygon& out, std::size_t axis, double limit, double slack) {
  out.n = 0;
  if (in.n == 0) return;
  const Vertex* a = &in.v[in.n - 1];
  bool a_inside = kAbove ? a->p[axis] >= limit : a->p[axis] <= limit;
  for (std::size_t i = 0; i < in.n; ++i) {
    const Vertex* b = &in.v[i];
    const bool b_inside = kAbove ? b->p[axis] >= limit : b->p[axis] <= limit;
    if (a_inside != b_inside) {
      const double t = (limit - a->p[axis]) / (b->p[axis] - a->p[axis]);
      out.v[out.n++] = interpolate(*a, *b, t, slack);
    }
    if (b_inside) out.v[out.n++] = *b;
    a = b;
    a_inside = b_inside;
  }
}

struct Bounds {
  std::array<double, 3> lo{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  std::array<double, 3> hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(const Vertex& v) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], v.p[k] - v.slack);
      hi[k] = std::max(hi[k], v.p[k] + v.slack);
    }
  }
};

// The nearest float not above x, or the one below that: without a branch, which would be
// mispredicted every other time.
float round_down(double x) {
  const auto f = static_cast<float>(x);
  // At least one unit in the last place of f, at most two.
  const float step = std::abs(f) * 0x1p-23F + std::numeric_limits<float>::denorm_min();
  return f - (static_cast<double>(f) > x ? step : 0.0F);
}

float round_up(double x) {
  return -round_down(-x);
}

// The box in single precision, cut to the region that it cannot leave; false if nothing remains.
bool to_box(const Bounds& bounds, const Box& region, Box& box) {
  bool valid = true;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    box.lo[k] = std::max(round_down(bounds.lo[i]), region.lo[k]);
    box.hi[k] = std::min(round_up(bounds.hi[i]), region.hi[k]);
    valid = valid & (box.lo[k] <= box.hi[k]);
  }
  return valid;
}

}  // namespace

SplitParts split_triangle(const std::array<Vec3, 3>& corners, const Box& cell, int axis,
                          float plane) {
  Box own;
  for (const Vec3& corner : corners) own.add(corner);
  const Vec3 reach = glm::max(glm::abs(own.lo), glm::abs(own.hi));
  const double slack =
      kRelativeSlack * static_cast<double>(std::max(reach.x, std::max(reach.y, reach.z)));

  Polygon buffers[2];
  Polygon* polygon = &buffers[0];
  Polygon* spare = &buffers[1];
  polygon->n = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    polygon->v[i] = {{corners[i].x, corners[i].y, corners[i].z}, 0.0};
  }
  for (int k = 0; k < 3; ++k) {
    if (own.lo[k] < cell.lo[k]) {
      clip_at<true>(*polygon, *spare, static_cast<std::size_t>(k),
                    static_cast<double>(cell.lo[k]) - slack, slack);
      std::swap(polygon, spare);
    }
    if (own.hi[k] > cell.hi[k]) {
      clip_at<false>(*polygon, *spare, static_cast<std::size_t>(k),
                     static_cast<double>(cell.hi[k]) + slack, slack);
      std::swap(polygon, spare);
    }
  }

  const auto split_axis = static_cast<std::size_t>(axis);
  Bounds left;
  Bounds right;
  clip_at<false>(*polygon, *spare, split_axis, static_cast<double>(plane) + slack, slack);
  for (std::size_t i = 0; i < spare->n; ++i) left.add(spare->v[i]);
  clip_at<true>(*polygon, *spare, split_axis, static_cast<double>(plane) - slack, slack);
  for (std::size_t i = 0; i < spare->n; ++i) right.add(spare->v[i]);

  Box region{glm::max(own.lo, cell.lo), glm::min(own.hi, cell.hi)};
  SplitParts parts;
  const float region_hi = region.hi[axis];
  region.hi[axis] = std::min(region_hi, plane);
  const bool left_valid = to_box(left, region, parts.left);
  region.hi[axis] = region_hi;
  region.lo[axis] = std::max(region.lo[axis], plane);
  const bool right_valid = to_box(right, region, parts.right);
  parts.in_left = left_valid && (parts.left.lo[axis] < plane || !right_valid);
  parts.in_right = right_valid && (parts.right.hi[axis] > plane || !parts.in_left);
  return parts;
}

}  // namespace sheaf
