// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "meshes.h"
#include "support/kd_stats.h"
#include "tree_checks.h"

namespace sheaf::test {
namespace {

// An independent greedy SAH build, O(N log^2 N): every node sorts the faces of its clipped
// triangles anew and counts by binary search. Polygons are clipped incrementally in double
// precision, without the conservative rounding of the builder. Only the cost is computed.
using Polygon = std::vector<Vec3d>;

struct CellD {
  Vec3d lo, hi;
  [[nodiscard]] double area() const {
    const Vec3d e = hi - lo;
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

Polygon clip(const Polygon& in, int axis, double limit, double sign) {
  Polygon out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Vec3d& a = in[i];
    const Vec3d& b = in[(i + 1) % in.size()];
    const double da = sign * (a[axis] - limit);
    const double db = sign * (b[axis] - limit);
    if (da <= 0.0) out.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) {
      Vec3d p = a + (b - a) * (da / (da - db));
      p[axis] = limit;
      out.push_back(p);
    }
  }
  return out;
}

struct Extent {
  double lo = HUGE_VAL, hi = -HUGE_VAL;
};

Extent extent_of(const Polygon& polygon, int axis) {
  Extent extent;
  for (const Vec3d& p : polygon) {
    extent.lo = std::min(extent.lo, p[axis]);
    extent.hi = std::max(extent.hi, p[axis]);
  }
  return extent;
}

struct OracleSplit {
  int axis = 0;
  double position = 0.0;
  bool planar_left = false;
};

struct Oracle {
  int max_depth;
  double root_area;

  static std::optional<OracleSplit> choose(const std::vector<Polygon>& polygons,
                                           const CellD& cell) {
    std::optional<OracleSplit> split;
    double best = 20.0 * static_cast<double>(polygons.size());
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> starts, ends, planars, candidates;
      for (const Polygon& polygon : polygons) {
        const Extent extent = extent_of(polygon, axis);
        candidates.insert(candidates.end(), {extent.lo, extent.hi});
        if (extent.lo == extent.hi) {
          planars.push_back(extent.lo);
        } else {
          starts.push_back(extent.lo);
          ends.push_back(extent.hi);
        }
      }
      for (auto* list : {&starts, &ends, &planars, &candidates})
        std::sort(list->begin(), list->end());
      const auto below = [](const std::vector<double>& list, double x) {
        return static_cast<double>(std::lower_bound(list.begin(), list.end(), x) - list.begin());
      };
      const auto above = [](const std::vector<double>& list, double x) {
        return static_cast<double>(list.end() - std::upper_bound(list.begin(), list.end(), x));
      };
      for (const double x : candidates) {
        if (!(x > cell.lo[axis] && x < cell.hi[axis])) continue;
        CellD left = cell, right = cell;
        left.hi[axis] = x;
        right.lo[axis] = x;
        const double in_plane =
            static_cast<double>(planars.size()) - below(planars, x) - above(planars, x);
        for (const bool planar_left : {false, true}) {
          const double n_left =
              below(starts, x) + below(planars, x) + (planar_left ? in_plane : 0.0);
          const double n_right =
              above(ends, x) + above(planars, x) + (planar_left ? 0.0 : in_plane);
          double cost = 15.0 + 20.0 * (left.area() * n_left + right.area() * n_right) / cell.area();
          if (n_left == 0.0 || n_right == 0.0) cost *= 0.8;
          if (cost < best) {
            best = cost;
            split = OracleSplit{axis, x, planar_left};
          }
        }
      }
    }
    return split;
  }

  [[nodiscard]] double cost(const std::vector<Polygon>& polygons, const CellD& cell,
                            int depth) const {
    const double weight = cell.area() / root_area;
    const auto split = depth < max_depth ? choose(polygons, cell) : std::nullopt;
    if (!split) return weight * 20.0 * static_cast<double>(polygons.size());
    CellD left = cell, right = cell;
    left.hi[split->axis] = split->position;
    right.lo[split->axis] = split->position;
    std::vector<Polygon> to_left, to_right;
    for (const Polygon& polygon : polygons) {
      const Extent e = extent_of(polygon, split->axis);
      const bool planar = e.lo == split->position && e.hi == split->position;
      if (planar ? split->planar_left : e.lo < split->position) {
        to_left.push_back(clip(polygon, split->axis, split->position, 1.0));
      }
      if (planar ? !split->planar_left : e.hi > split->position) {
        to_right.push_back(clip(polygon, split->axis, split->position, -1.0));
      }
    }
    return weight * 15.0 + cost(to_left, left, depth + 1) + cost(to_right, right, depth + 1);
  }
};

double oracle_cost(const Mesh& mesh, const KdTree& tree) {
  std::vector<Polygon> polygons;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corners = mesh.corners(i);
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    polygons.push_back({Vec3d(corners[0]), Vec3d(corners[1]), Vec3d(corners[2])});
  }
  const CellD cell{Vec3d(tree.bounds.lo), Vec3d(tree.bounds.hi)};
  const int max_depth =
      static_cast<int>(8.0 + 1.3 * std::log2(static_cast<double>(polygons.size())));
  return Oracle{max_depth, cell.area()}.cost(polygons, cell, 0);
}

TEST(SahQuality, CostIsWithinTwoPercentOfAnExactSweep) {
  std::vector<Mesh> meshes = sample_meshes();
  meshes.push_back(random_soup(6000, 0.05F));
  meshes.push_back(sphere(40));
  meshes.push_back(boxes_in_room(16));
  for (const Mesh& mesh : meshes) {
    const KdTree tree = build(mesh);
    const double exact = oracle_cost(mesh, tree);
    const double cost = measure_kd_tree(tree, 15.0, 20.0).sah_cost;
    EXPECT_NEAR(cost / exact, 1.0, 0.02) << mesh.name << ' ' << mesh.triangles.size();
  }
}

}  // namespace
}  // namespace sheaf::test
