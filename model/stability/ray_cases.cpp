// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Hits against three oracles: the same test on every triangle, doubles, integers without rounding.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "stability/catalogue.h"
#include "stability/double_hit.h"
#include "stability/exact.h"
#include "stability/ray_scenes.h"

namespace sheaf::stability {
namespace {

constexpr int kRays = 12000;
/// No more than so many triangles are tested one by one: fewer rays for larger meshes.
constexpr std::size_t kTests = 18'000'000;
/// Of how many rays one is held against exact arithmetic on every triangle, which takes a while.
constexpr int kExactEvery = 20;

const char* const kNoLoss =
    "the traversal tests a superset of what it must, with one arithmetic for all schemes "
    "(decision 0011)";
const char* const kSameSteps =
    "a lane is active where its ray alone would go: the planes' distances are the same numbers";
const char* const kSixUlps =
    "corners move by u (2 |k| + 4 |z|) along either axis k, at most 4u (|k| + |z|): roundings of "
    "(a_k - o_k) - s (a_z - o_z) and of s, after Woop, Benthin and Wald 2013, section 4.2; along "
    "both, sqrt(2) times that, 5.66, rounded up for terms in u^2";
const char* const kTBound =
    "the slope of t times how far corners move, 4 roundings in each weight and 9 in t "
    "(double_hit.cpp)";
const char* const kMonotone =
    "a difference of two rounded products never has the wrong sign, and products of floats are "
    "exact in doubles (watertight.h)";

/// Errors of the closest hits of one scene.
class RayMeasurement {
 public:
  explicit RayMeasurement(const RayScene& source) : source_(source), scene_(source.mesh) {}

  std::vector<Finding> run(int num_rays) {
    Random random(7);
    for (int i = 0; i < num_rays; ++i) {
      const Ray ray = source_.ray(scene_, random);
      const Hit hit = test_all(scene_, ray);
      for (const auto scheme : kTraversalSchemes) {
        lost_.check(trace_one(scene_, ray, scheme) == hit, [&] { return describe(ray); });
      }
      steps_.check(masked_takes_steps_of_single(scene_, ray), [&] { return describe(ray); });
      hold_against_doubles(ray, hit);
      if (hit.triangle != kNoHit) hold_against_integers(ray, hit);
      if (i % kExactEvery == 0) check_decisions(ray);
    }
    return {
        lost_.finding("hits that a scheme loses or changes", kNoLoss),
        steps_.finding("rays whose steps in a packet are not those they take alone", kSameSteps),
        signs_.finding("edge decisions unlike exact arithmetic's", kMonotone),
        outside_.finding("distance of a hit outside its triangle, in u × reach", {6, kSixUlps}),
        exact_outside_.finding("the same by exact arithmetic, in u × reach", {6, kSixUlps}),
        overlooked_.finding("triangles overlooked that are surely nearer", kSixUlps),
        t_.finding("error of t in units of its bound, exact arithmetic", {1, kTBound})};
  }

 private:
  /// 2^-24 × the distance to the farthest corner along the axes that the shear mixes.
  static double unit(const DoubleHit& hit) { return hit.margin_error / 6.0; }

  void hold_against_doubles(const Ray& ray, const Hit& hit) {
    double until = std::numeric_limits<double>::infinity();
    if (hit.triangle != kNoHit) {
      const DoubleHit own = hit_in_doubles(scene_.records[hit.triangle], ray);
      outside_.add(std::max(0.0, -own.margin) / unit(own), [&] { return describe(ray); });
      until = double{hit.t};
    }
    for (const TriangleRecord& record : scene_.records) {
      const DoubleHit other = hit_in_doubles(record, ray);
      overlooked_.check(!(other.margin > other.margin_error && other.t > other.t_error &&
                          other.t + other.t_error < until),
                        [&] { return describe(ray); });
    }
  }

  void hold_against_integers(const Ray& ray, const Hit& hit) {
    const TriangleRecord& record = scene_.records[hit.triangle];
    const DoubleHit bound = hit_in_doubles(record, ray);
    const ExactHit exact = hit_exactly(record, ray);
    exact_outside_.add(std::max(0.0, -exact.margin) / unit(bound), [&] { return describe(ray); });
    // A triangle seen edge-on has no t of its own.
    if (!std::isfinite(exact.t) || !std::isfinite(bound.t_error)) return;
    const double error = std::abs(exact.t - double{hit.t});
    t_.add(error == 0.0 ? 0.0 : error / bound.t_error, [&] { return describe(ray); });
  }

  void check_decisions(const Ray& ray) {
    const ShearedRay sheared(ray.origin, ray.direction);
    for (const TriangleRecord& record : scene_.records) {
      const ShearedTriangle seen = sheared.shear(&record.a.x);
      TriangleHit ignored{};
      signs_.check(hit_sheared(seen, ignored) == contains_axis(seen),
                   [&] { return describe(ray); });
    }
  }

  const RayScene& source_;
  const MeshScene scene_;
  Failures lost_, steps_, signs_, overlooked_;
  Largest outside_, exact_outside_, t_;
};

}  // namespace

std::vector<StabilityCase> ray_cases() {
  std::vector<RayScene> scenes = ray_scenes();
  std::ranges::move(surface_ray_scenes(), std::back_inserter(scenes));
  std::vector<StabilityCase> cases;
  for (const RayScene& scene : scenes) {
    const auto affordable = static_cast<int>(kTests / scene.mesh.triangles.size());
    const int num_rays = std::min(kRays, affordable);
    cases.push_back({"rays", scene.name, scene.extreme, [scene, num_rays](const Effort& effort) {
                       return RayMeasurement(scene).run(effort.trials(num_rays));
                     }});
  }
  return cases;
}

}  // namespace sheaf::stability
