// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "meshes.h"
#include "tree_checks.h"

namespace sheaf::test {
namespace {

// Every point of a triangle lies in a leaf that lists the triangle. A point on a split plane lies
// in several; the triangle must be in one of them. Samples are rounded, so a leaf within the
// rounding error of the point counts too.
TEST(KdReachability, LeafAroundAPointOfATriangleListsTheTriangle) {
  Random random(21);
  for (const Mesh& mesh : sample_meshes()) {
    const KdTree tree = build(mesh);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto corners = mesh.corners(i);
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        continue;
      for (int sample = 0; sample < 20; ++sample) {
        double u = sample < 3 ? 0.0 : random.uniform();
        double v = sample < 3 ? 0.0 : random.uniform();
        if (u + v > 1.0) {
          u = 1.0 - u;
          v = 1.0 - v;
        }
        const Vec3d a(corners[static_cast<std::size_t>(sample) % 3]);
        const Vec3d b(corners[static_cast<std::size_t>(sample + 1) % 3]);
        const Vec3d c(corners[static_cast<std::size_t>(sample + 2) % 3]);
        const Vec3d point = a + u * (b - a) + v * (c - a);
        const Vec3d error = 1e-15 * glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
        bool found = false;
        for (int corner = 0; corner < 8 && !found; ++corner) {
          const Vec3d shift((corner & 1) != 0 ? error.x : -error.x,
                            (corner & 2) != 0 ? error.y : -error.y,
                            (corner & 4) != 0 ? error.z : -error.z);
          for_leaves_around(tree, point + shift, [&](const KdNode& leaf, const Box&) {
            found = found || leaf_lists(tree, leaf, i);
          });
        }
        ASSERT_TRUE(found) << mesh.name << " triangle " << i;
      }
    }
  }
}

struct RayD {
  Vec3d origin, direction;
};

constexpr double kMiss = std::numeric_limits<double>::infinity();

// Moeller and Trumbore in double precision, borders included.
double hit_distance(const RayD& ray, const std::array<Vec3, 3>& corners) {
  // The formula needs an area; rounding can let it see one in a triangle with equal corners.
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
    return kMiss;
  }
  const Vec3d a(corners[0]);
  const Vec3d e1 = Vec3d(corners[1]) - a;
  const Vec3d e2 = Vec3d(corners[2]) - a;
  const Vec3d p = glm::cross(ray.direction, e2);
  const double det = glm::dot(e1, p);
  if (det == 0.0) return kMiss;
  const Vec3d s = ray.origin - a;
  const double u = glm::dot(s, p) / det;
  const Vec3d q = glm::cross(s, e1);
  const double v = glm::dot(ray.direction, q) / det;
  const double t = glm::dot(e2, q) / det;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 ? t : kMiss;
}

double brute_force(const RayD& ray, const Mesh& mesh) {
  double best = kMiss;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    best = std::min(best, hit_distance(ray, mesh.corners(i)));
  }
  return best;
}

// Conservative scalar traversal as the contract of build.h asks for: near child to t (1 + eps), far
// child from t (1 - eps), both if the ray lies in the plane.
struct Traversal {
  const Mesh& mesh;
  const KdTree& tree;
  const RayD& ray;
  double eps;
  double best = kMiss;
  std::size_t num_tests = 0;

  void visit(std::size_t index, double t_min, double t_max) {
    const KdNode& node = tree.nodes[index];
    if (node.is_leaf()) {
      for (std::uint32_t i = 0; i < node.count(); ++i) {
        best =
            std::min(best, hit_distance(ray, mesh.corners(tree.leaf_triangles[node.first() + i])));
        ++num_tests;
      }
      return;
    }
    const std::size_t left = index + 1;
    const std::size_t right = node.right_child();
    const double distance = static_cast<double>(node.split()) - ray.origin[node.axis()];
    const double slope = ray.direction[node.axis()];
    if (slope == 0.0) {
      if (distance >= 0.0) visit(left, t_min, t_max);
      if (distance <= 0.0) visit(right, t_min, t_max);
      return;
    }
    const double t = distance / slope;
    const double margin = eps * (std::abs(t) + 1.0);
    const double near_end = std::min(t_max, t + margin);
    const double far_begin = std::max(t_min, t - margin);
    if (near_end >= t_min) visit(slope > 0.0 ? left : right, t_min, near_end);
    if (far_begin <= t_max) visit(slope > 0.0 ? right : left, far_begin, t_max);
  }
};

RayD random_ray(Random& random, const Mesh& mesh, const Box& bounds, int number) {
  const auto in_bounds = [&] {
    Vec3d p;
    for (int k = 0; k < 3; ++k) {
      const double share = 1.5 * static_cast<double>(random.uniform()) - 0.25;
      p[k] = bounds.lo[k] + share * (static_cast<double>(bounds.hi[k]) - bounds.lo[k]);
    }
    return p;
  };
  RayD ray{in_bounds(), {}};
  const auto corners = mesh.corners(random.below(mesh.triangles.size()));
  const Vec3d a(corners[0]);
  const Vec3d b(corners[1]);
  switch (number % 4) {
    case 0:
      ray.direction = in_bounds() - ray.origin;
      break;
    case 1:  // at a vertex
      ray.direction = a - ray.origin;
      break;
    case 2:  // at the middle of an edge
      ray.direction = 0.5 * (a + b) - ray.origin;
      break;
    default:  // along an axis, through a vertex and so in a likely split plane
      ray.direction = Vec3d(0.0);
      ray.direction[number % 3] = number % 8 < 4 ? 1.0 : -1.0;
      ray.origin = a - 2.0 * glm::length(Vec3d(bounds.extent())) * ray.direction;
      break;
  }
  // Unit of t: about the scene's size, so that the margin's absolute part means the same
  // everywhere.
  const double size = glm::length(Vec3d(bounds.extent()));
  const double length = glm::length(ray.direction);
  if (length > 0.0) ray.direction *= size / length;
  return ray;
}

TEST(KdReachability, NoHitOfARayIsLost) {
  Random random(22);
  for (const Mesh& mesh : sample_meshes()) {
    const KdTree tree = build(mesh);
    std::size_t num_hits = 0;
    std::size_t num_tests = 0;
    constexpr int kNumRays = 1500;
    for (int i = 0; i < kNumRays; ++i) {
      const RayD ray = random_ray(random, mesh, tree.bounds, i);
      const double expected = brute_force(ray, mesh);
      // Small beside a float's epsilon, but above the errors of the test's own arithmetic, which
      // grow with the distance of the scene from the world's origin.
      const double reach =
          glm::length(glm::max(glm::abs(Vec3d(tree.bounds.lo)), glm::abs(Vec3d(tree.bounds.hi)))) /
          glm::length(Vec3d(tree.bounds.extent()));
      Traversal traversal{mesh, tree, ray, 1e-14 * (1.0 + reach)};
      traversal.visit(0, 0.0, kMiss);
      ASSERT_EQ(traversal.best, expected) << mesh.name << " ray " << i;
      num_hits += expected < kMiss ? 1U : 0U;
      num_tests += traversal.num_tests;
    }
    // The comparison means something: many rays hit, and the tree spares most of the tests.
    EXPECT_GT(num_hits, kNumRays / 20U) << mesh.name;
    EXPECT_LT(num_tests, kNumRays * mesh.triangles.size() / 2) << mesh.name;
  }
}

}  // namespace
}  // namespace sheaf::test
