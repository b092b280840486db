// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// An experiment: split planes in fewer bits. A plane that is stored rounded stands for all that
// rounds to it, so that a ray visits both children in between: no hit is lost, and steps are added.
#include <Imath/half.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/watertight.h"
#include "stability/catalogue.h"
#include "stability/mesh_scene.h"

namespace sheaf::stability {
namespace {

struct Slab {
  double lo, hi;
};

/// What a stored plane may stand for.
struct PlaneFormat {
  const char* name;
  int bits;
  Slab (*slab)(float plane, float lo, float hi);  ///< lo and hi bound the scene along the axis
};

Slab as_float(float plane, float /*lo*/, float /*hi*/) {
  return {double{plane}, double{plane}};
}

/// The half and the next one away from the plane on the other side.
Slab as_half(float plane, float /*lo*/, float /*hi*/) {
  const Imath::half stored(plane);
  const double ulp = std::ldexp(1.0, std::max(std::ilogb(float{stored}), -14) - 10);
  return {double{float{stored}} - 0.5 * ulp, double{float{stored}} + 0.5 * ulp};
}

/// A share of the scene's box, rounded down.
template <int kBits>
Slab as_fixed(float plane, float lo, float hi) {
  const double step = (double{hi} - double{lo}) / std::ldexp(1.0, kBits);
  if (step == 0.0) return {double{plane}, double{plane}};
  const double low = double{lo} + std::floor((double{plane} - double{lo}) / step) * step;
  // A share of a step more, for the rounding of this.
  return {low - 1e-9 * step, low + (1.0 + 1e-9) * step};
}

constexpr PlaneFormat kFormats[] = {{"half", 16, as_half},
                                    {"fixed 16", 16, as_fixed<16>},
                                    {"fixed 12", 12, as_fixed<12>},
                                    {"fixed 8", 8, as_fixed<8>}};

/// One ray's walk through a tree of rounded planes, written to be read.
class Walk {
 public:
  Walk(const MeshScene& scene, const PlaneFormat& format, const Ray& ray)
      : scene_(scene),
        format_(format),
        ray_(ray),
        sheared_(ray.origin, ray.direction),
        best_{kNoHit, ray.t_max} {
    const Box& box = scene.tree.bounds;
    const Vec3 reach = glm::max(glm::abs(box.lo - ray.origin), glm::abs(box.hi - ray.origin));
    slack_ = 1e-6 * double{std::max({reach.x, reach.y, reach.z})};  // of the triangle test: 12 u
    Slab part{0.0, std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
      part = clip(part, axis, {double{box.lo[axis]} - slack_, double{box.hi[axis]} + slack_});
    }
    visit(0, part);
  }
  [[nodiscard]] Hit hit() const { return best_.triangle == kNoHit ? Hit{} : best_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }

 private:
  /// The part of a part of the ray that lies within a slab of space.
  [[nodiscard]] Slab clip(Slab part, int axis, Slab space) const {
    const double o = double{ray_.origin[axis]};
    const double d = double{ray_.direction[axis]};
    if (d == 0.0) return o >= space.lo && o <= space.hi ? part : Slab{1.0, 0.0};
    const double first = ((d > 0.0 ? space.lo : space.hi) - o) / d;
    const double last = ((d > 0.0 ? space.hi : space.lo) - o) / d;
    return {std::max(part.lo, first), std::min(part.hi, last)};
  }

  void visit(std::uint32_t index, Slab part) {
    if (!(part.lo <= part.hi) || part.lo > double{best_.t} + slack_) return;
    const KdNode node = scene_.tree.nodes[index];
    if (node.is_leaf()) {
      test(node);
      return;
    }
    ++steps_;
    const int axis = node.axis();
    const Box& box = scene_.tree.bounds;
    const Slab plane = format_.slab(node.split(), box.lo[axis], box.hi[axis]);
    constexpr double kFar = std::numeric_limits<double>::infinity();
    const Slab left = clip(part, axis, {-kFar, plane.hi + slack_});
    const Slab right = clip(part, axis, {plane.lo - slack_, kFar});
    if (ray_.direction[axis] >= 0.0F) {
      visit(index + 1, left);
      visit(node.right_child(), right);
    } else {
      visit(node.right_child(), right);
      visit(index + 1, left);
    }
  }

  void test(const KdNode& leaf) {
    for (std::uint32_t i = 0; i < leaf.count(); ++i) {
      const std::uint32_t triangle = scene_.tree.leaf_triangles[leaf.first() + i];
      TriangleHit hit;
      if (!hit_sheared(sheared_.shear(&scene_.records[triangle].a.x), hit)) continue;
      const bool wins = hit.t < best_.t || (hit.t == best_.t && triangle < best_.triangle);
      if (hit.t >= 0.0F && wins) best_ = {triangle, hit.t};
    }
  }

  const MeshScene& scene_;
  const PlaneFormat& format_;
  const Ray& ray_;
  const ShearedRay sheared_;
  Hit best_;
  double slack_ = 0.0;
  std::uint64_t steps_ = 0;
};

std::vector<Finding> planes_in_fewer_bits(const Mesh& mesh, int num_rays) {
  constexpr PlaneFormat kFull{"float", 32, as_float};
  const MeshScene scene(mesh);
  std::vector<Finding> findings;
  for (const PlaneFormat& format : kFormats) {
    Failures lost;
    Random random(91);
    std::uint64_t full = 0;
    std::uint64_t rounded = 0;
    for (int i = 0; i < num_rays; ++i) {
      const Ray ray = random_ray(random, scene.tree.bounds);
      const Walk walk(scene, format, ray);
      lost.check(walk.hit() == test_all(scene, ray), [&] { return describe(ray); });
      rounded += walk.steps();
      full += Walk(scene, kFull, ray).steps();
    }
    findings.push_back(lost.finding(fmt::format("hits lost with planes in {}", format.name),
                                    "a rounded plane stands for all that rounds to it"));
    const double more = static_cast<double>(rounded) / static_cast<double>(full) - 1.0;
    findings.push_back(
        {fmt::format("steps added for {} bits saved a plane", 32 - format.bits),
         full,
         more,
         {std::numeric_limits<double>::infinity(), "an experiment: told, not judged"},
         ""});
  }
  return findings;
}

}  // namespace

std::vector<StabilityCase> precision_cases() {
  constexpr int kRays = 4000;
  const auto of = [](Mesh mesh) {
    return
        [mesh](const Effort& effort) { return planes_in_fewer_bits(mesh, effort.trials(kRays)); };
  };
  return {{"precision", "planes of a sphere", "split planes in 16, 12 and 8 bits",
           of(bumpy_sphere(40, 60, 0.1F))},
          {"precision", "planes of a soup", "the same where triangles overlap",
           of(soup(2000, 0.1F, 2))},
          {"precision", "planes of a stadium", "the same with all detail in a millionth of the box",
           of(teapot_in_stadium(0.1F, 1e4F))}};
}

}  // namespace sheaf::stability
