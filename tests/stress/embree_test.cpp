// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// The extreme scenes of the catalogue against Embree in robust mode.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "stability/catalogue.h"  // gamma()
#include "stability/double_hit.h"
#include "stability/ray_scenes.h"
#include "support/embree_oracle.h"

namespace sheaf::stability {
namespace {

/// The triangle that the ray surely hits before all others, so that every right answer names it.
/// kNoHit if rounding may decide, be it between two triangles or whether one is hit at all.
std::uint32_t only_answer(const MeshScene& scene, const Ray& ray) {
  std::vector<DoubleHit> hits;
  for (const TriangleRecord& record : scene.records) hits.push_back(hit_in_doubles(record, ray));
  const auto may_be_hit = [](const DoubleHit& hit) {
    return !(hit.margin < -hit.margin_error) && !(hit.t < -hit.t_error);
  };
  std::size_t first = hits.size();
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool surely = hits[i].margin > hits[i].margin_error && hits[i].t > hits[i].t_error;
    if (surely && (first == hits.size() || hits[i].t < hits[first].t)) first = i;
  }
  if (first == hits.size()) return kNoHit;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool surely_behind = hits[i].t - hits[i].t_error > hits[first].t + hits[first].t_error;
    if (i != first && may_be_hit(hits[i]) && !surely_behind) return kNoHit;
  }
  return static_cast<std::uint32_t>(first);
}

/// How far rounding may move Embree's t. In robust mode it is (v · n) / (d · n), with corners v
/// relative to the origin and n = e × f of the differences of those
/// (triangle_intersector_pluecker.h of Embree 3.13), where ours is a mean of three. With L the
/// longest edge and R the farthest corner, edges are off by u (2 R + L) and their cross product by
/// that and two roundings of its products, which are no longer than 2 L². That turns n and so moves
/// t by up to L |dn| / (d · n); corners, and either dot product, have 1 and 2 × 3 roundings of R
/// |n|, and the quotient 4 of t.
double embree_t_error(const TriangleRecord& record, const Ray& ray) {
  constexpr double kHalfUlp = 0x1p-24;
  const Vec3d e = Vec3d(record.b) - Vec3d(record.a);
  const Vec3d f = Vec3d(record.c) - Vec3d(record.a);
  const double longest = std::max({glm::length(e), glm::length(f), glm::length(f - e)});
  double reach = 0.0;
  for (const Vec3& corner : {record.a, record.b, record.c}) {
    reach = std::max(reach, glm::length(Vec3d(corner) - Vec3d(ray.origin)));
  }
  const Vec3d normal = glm::cross(e, f);
  const double edge_error = kHalfUlp * (2.0 * reach + longest);
  const double turned =
      edge_error * (2.0 * longest + edge_error) + gamma(2) * 2.0 * longest * longest;
  const double along = std::abs(glm::dot(Vec3d(ray.direction), normal)) - turned;
  if (!(along > 0.0)) return std::numeric_limits<double>::infinity();
  return (longest * turned + gamma(7) * reach * (glm::length(normal) + turned)) / along +
         gamma(4) * reach;
}

/// What Embree and Sheaf say of some rays.
struct Comparison {
  int met = 0;   ///< rays of which both name a triangle, each one that rounding explains
  int only = 0;  ///< rays with one right answer, which both give
};

Comparison compare(const RayScene& source, int num_rays) {
  const MeshScene scene(source.mesh);
  const test::EmbreeOracle embree(scene.mesh.positions, scene.mesh.triangles);
  Random random(81);
  Comparison comparison;
  for (int i = 0; i < num_rays; ++i) {
    const Ray ray = source.ray(scene, random);
    const Hit ours = trace_one(scene, ray, TraversalScheme::kMasked);
    const test::EmbreeOracle::Hit embrees = embree.closest(ray);
    const Hit theirs{embrees.triangle, embrees.t};
    // Margin, t and what was overlooked: of either answer, by its own arithmetic.
    EXPECT_TRUE(explains(scene, ray, ours)) << source.name << ": " << describe(ray);
    const bool met = theirs.triangle != kNoHit;
    const double slack = met ? embree_t_error(scene.records[theirs.triangle], ray) : 0.0;
    EXPECT_TRUE(explains(scene, ray, theirs, slack))
        << source.name << ", Embree: " << describe(ray);
    comparison.met += static_cast<int>(ours.triangle != kNoHit && met);
    const std::uint32_t only = only_answer(scene, ray);
    if (only == kNoHit) continue;
    ++comparison.only;
    EXPECT_EQ(ours.triangle, only) << source.name << ": " << describe(ray);
    EXPECT_EQ(theirs.triangle, only) << source.name << ", Embree: " << describe(ray);
  }
  return comparison;
}

/// Scenes in which rounding always has a say: rays exactly at edges, copies of triangles, needles
/// thinner than rounding, origins too far off.
bool is_never_sure(const std::string& name) {
  constexpr std::array kNames = {"needles",
                                 "slivers",
                                 "degenerate and duplicate",
                                 "coplanar walls",
                                 "shared edges and corners",
                                 "far origins",
                                 "at edges of spindle"};
  return std::ranges::find(kNames, name) != kNames.end();
}

void compare_all(const std::vector<RayScene>& scenes) {
  for (const RayScene& source : scenes) {
    const auto affordable = static_cast<int>(2'000'000 / source.mesh.triangles.size());
    const Comparison comparison = compare(source, std::min(2000, affordable));
    EXPECT_GT(comparison.met, 0) << source.name;
    EXPECT_EQ(comparison.only == 0, is_never_sure(source.name)) << source.name;
  }
}

TEST(Embree, AnswersExtremeScenesAlike) {
  compare_all(ray_scenes());
}

TEST(Embree, AnswersAlikeAtEdgesOfClosedMeshesAndGrazingSurfaces) {
  compare_all(surface_ray_scenes());
}

}  // namespace
}  // namespace sheaf::stability
