// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// An experiment: split planes and rays in fewer bits (traversal/reduced_precision.h). No hit may be
// lost; the steps added are told.
#include <fmt/format.h>

#include <limits>
#include <utility>

#include "stability/catalogue.h"
#include "stability/mesh_scene.h"
#include "traversal/reduced_precision.h"

namespace sheaf::stability {
namespace {

/// What one way of storing costs on one scene.
class Measurement {
 public:
  Measurement(std::string stored, const ReducedPrecision& precision)
      : stored_(std::move(stored)), precision_(precision) {}

  void add(const MeshScene& scene, const Ray& ray, const Hit& hit, std::uint64_t full_steps) {
    const ReducedTrace found = trace_reduced(precision_, scene.tree, scene.records, ray);
    const bool same =
        found.triangle == hit.triangle && (hit.triangle == kNoHit || found.t == hit.t);
    lost_.check(same, [&] { return describe(ray); });
    steps_ += found.steps;
    full_steps_ += full_steps;
  }

  void report(std::vector<Finding>& findings) const {
    findings.push_back(lost_.finding(fmt::format("hits lost with {}", stored_),
                                     "what is stored rounded stands for all that rounds to it"));
    const double more = static_cast<double>(steps_) / static_cast<double>(full_steps_) - 1.0;
    findings.push_back(
        {fmt::format("steps added with {}, per step", stored_),
         full_steps_,
         more,
         {std::numeric_limits<double>::infinity(), "an experiment: told, not judged"},
         ""});
  }

 private:
  const std::string stored_;
  const ReducedPrecision precision_;
  Failures lost_;
  std::uint64_t steps_ = 0, full_steps_ = 0;
};

/// Every other one at a corner, where split planes are: there it shows what they stand for.
Ray ray_number(int i, const MeshScene& scene, Random& random) {
  const Ray ray = random_ray(random, scene.tree.bounds);
  if (i % 2 == 0) return ray;
  const Vec3 to = scene.records[random.below(scene.records.size())].a - ray.origin;
  return to == Vec3(0.0F) ? ray : make_ray(ray.origin, glm::normalize(to));
}

std::vector<Finding> in_fewer_bits(const Mesh& mesh, int num_rays) {
  const MeshScene scene(mesh);
  const Vec3 margin = 0.1F * scene.tree.bounds.extent();  // random_ray()'s
  const Box space{scene.tree.bounds.lo - margin, scene.tree.bounds.hi + margin};
  std::vector<Measurement> measurements;
  for (const NumberFormat& format : kReducedFormats) {
    measurements.emplace_back(fmt::format("planes in {}", format.name),
                              ReducedPrecision{format, kFullPrecision, space});
    measurements.emplace_back(fmt::format("planes and rays in {}", format.name),
                              ReducedPrecision{format, format, space});
  }
  Random random(91);
  for (int i = 0; i < num_rays; ++i) {
    const Ray ray = ray_number(i, scene, random);
    const Hit hit = test_all(scene, ray);
    const std::uint64_t steps = trace_reduced({}, scene.tree, scene.records, ray).steps;
    for (Measurement& measurement : measurements) measurement.add(scene, ray, hit, steps);
  }
  std::vector<Finding> findings;
  for (const Measurement& measurement : measurements) measurement.report(findings);
  return findings;
}

}  // namespace

std::vector<StabilityCase> precision_cases() {
  constexpr int kRays = 4000;
  const auto of = [](Mesh mesh) {
    return [mesh = std::move(mesh)](const Effort& effort) {
      return in_fewer_bits(mesh, effort.trials(kRays));
    };
  };
  return {
      {"precision", "bits of a sphere", "split planes and rays in 16, 12 and 8 bits",
       of(bumpy_sphere(40, 60, 0.1F))},
      {"precision", "bits of a soup", "the same where triangles overlap", of(soup(2000, 0.1F, 2))},
      {"precision", "bits of a stadium", "the same with all detail in a millionth of the box",
       of(teapot_in_stadium(0.1F, 1e4F))}};
}

}  // namespace sheaf::stability
