// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// The extreme scenes of the catalogue against Embree in robust mode.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

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
    EXPECT_TRUE(explains(scene, ray, theirs)) << source.name << ", Embree: " << describe(ray);
    comparison.met += static_cast<int>(ours.triangle != kNoHit && theirs.triangle != kNoHit);
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
