// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "shading/reference_hit.h"

#include <algorithm>
#include <cmath>

namespace sheaf {
namespace {

/// Part of a ray.
struct Interval {
  double begin;
  double end;
  [[nodiscard]] bool empty() const { return !(begin <= end); }
};

/// Keeps of `part` what has a coordinate at or below `limit`: origin + t · direction <= limit.
Interval clip_below(Interval part, double origin, double direction, double limit) {
  if (direction == 0.0) {
    return origin <= limit ? part : Interval{1.0, 0.0};
  }
  const double t = (limit - origin) / direction;
  return direction > 0.0 ? Interval{part.begin, std::min(part.end, t)}
                         : Interval{std::max(part.begin, t), part.end};
}

Interval clip_above(Interval part, double origin, double direction, double limit) {
  return clip_below(part, -origin, -direction, -limit);
}

/// A corner of a triangle as the ray sees it: across the ray, and along its largest axis.
struct Corner {
  double x, y, depth;
};

/// Twice the signed area between the ray and the edge from a to b. Its sign is never wrong, since
/// rounding two products does not change which is larger; and from b to a it is the same number,
/// negated.
double edge(const Corner& a, const Corner& b) {
  return a.x * b.y - a.y * b.x;
}

/// Triangles that share corners see the same Corner there, so by edge() a ray can slip through
/// neither between them nor past a corner (the argument of Woop, Benthin and Wald, "Watertight
/// Ray/Triangle Intersection", JCGT 2(1), 2013; in doubles, and both sides are met).
std::optional<ReferenceHit> intersect(const Scene& scene, std::uint32_t triangle,
                                      const ReferenceRay& ray) {
  const Vec3d& d = ray.direction;
  const Vec3d size = glm::abs(d);
  const int z = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const int x = (z + 1) % 3;
  const int y = (z + 2) % 3;
  const auto seen = [&](std::uint32_t vertex) {
    const Vec3d p = Vec3d(scene.positions[vertex]) - ray.origin;
    return Corner{p[x] - d[x] / d[z] * p[z], p[y] - d[y] / d[z] * p[z], p[z] / d[z]};
  };
  const auto& [ia, ib, ic] = scene.triangles[triangle];
  const Corner a = seen(ia);
  const Corner b = seen(ib);
  const Corner c = seen(ic);
  const double wa = edge(b, c);
  const double wb = edge(c, a);
  const double wc = edge(a, b);
  const bool inside =
      (wa >= 0.0 && wb >= 0.0 && wc >= 0.0) || (wa <= 0.0 && wb <= 0.0 && wc <= 0.0);
  const double sum = wa + wb + wc;
  if (!inside || sum == 0.0) {
    return std::nullopt;
  }
  const double t = (wa * a.depth + wb * b.depth + wc * c.depth) / sum;
  if (!(t >= 0.0 && t <= ray.t_max)) {
    return std::nullopt;
  }
  return ReferenceHit{t, wb / sum, wc / sum, triangle};
}

/// Walks the tree with planes thickened by `slack` to both sides, so that neither the rounding of
/// the builder nor that of this walk can hide a triangle that touches a plane.
class Walk {
 public:
  Walk(const Scene& scene, const KdTree& tree, const ReferenceRay& ray, bool any)
      : scene_(scene), tree_(tree), ray_(ray), any_(any) {
    const Vec3d reach = glm::max(glm::abs(Vec3d(tree.bounds.lo)), glm::abs(Vec3d(tree.bounds.hi)));
    slack_ = 1e-6 * std::max({reach.x, reach.y, reach.z});
    Interval part{0.0, ray.t_max};
    for (int axis = 0; axis < 3; ++axis) {
      const double o = ray.origin[axis];
      const double d = ray.direction[axis];
      part = clip_above(part, o, d, static_cast<double>(tree.bounds.lo[axis]) - slack_);
      part = clip_below(part, o, d, static_cast<double>(tree.bounds.hi[axis]) + slack_);
    }
    visit(0, part);
  }

  [[nodiscard]] const std::optional<ReferenceHit>& best() const { return best_; }

 private:
  void visit(std::uint32_t index, Interval part) {
    if (part.empty() || (best_ && (any_ || part.begin > best_->t))) {
      return;
    }
    const KdNode& node = tree_.nodes[index];
    if (node.is_leaf()) {
      test(node);
      return;
    }
    const double o = ray_.origin[node.axis()];
    const double d = ray_.direction[node.axis()];
    const auto split = static_cast<double>(node.split());
    const Interval left = clip_below(part, o, d, split + slack_);
    const Interval right = clip_above(part, o, d, split - slack_);
    if (d >= 0.0) {
      visit(index + 1, left);
      visit(node.right_child(), right);
    } else {
      visit(node.right_child(), right);
      visit(index + 1, left);
    }
  }

  void test(const KdNode& leaf) {
    for (std::uint32_t i = 0; i < leaf.count(); ++i) {
      const auto hit = intersect(scene_, tree_.leaf_triangles[leaf.first() + i], ray_);
      if (!hit || (any_ && !(hit->t < ray_.t_max))) {
        continue;
      }
      if (!best_ || hit->t < best_->t || (hit->t == best_->t && hit->triangle < best_->triangle)) {
        best_ = hit;
      }
    }
  }

  const Scene& scene_;
  const KdTree& tree_;
  const ReferenceRay& ray_;
  bool any_;
  double slack_ = 0.0;
  std::optional<ReferenceHit> best_;
};

}  // namespace

std::optional<ReferenceHit> reference_closest_hit(const Scene& scene, const KdTree& tree,
                                                  const ReferenceRay& ray) {
  return Walk(scene, tree, ray, false).best();
}

bool reference_occluded(const Scene& scene, const KdTree& tree, const ReferenceRay& ray) {
  return Walk(scene, tree, ray, true).best().has_value();
}

}  // namespace sheaf
