// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/hit_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "scene/camera.h"
#include "scene/load_gltf.h"

namespace sheaf::test {
namespace {

constexpr std::size_t kListed = 4;  // of each kind and explanation
constexpr Shader::Options kOneBounce{.recursion_level = 1, .weight_cutoff = 0.0F};

/// Distance between floats of this size.
double float_ulp(double of) {
  return std::ldexp(1.0, std::max(std::ilogb(std::max(of, 1e-37)), -126) - 23);
}

/// A triangle as the ray sees it, in double precision.
struct SeenTriangle {
  SeenTriangle(const Ray& ray, const TriangleRecord& triangle) {
    const Vec3d direction = glm::normalize(Vec3d(ray.direction));
    const Vec3d other = std::fabs(direction.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d right = glm::normalize(glm::cross(direction, other));
    const Vec3d up = glm::cross(right, direction);
    std::array<Vec3d, 3> corners{Vec3d(triangle.a), Vec3d(triangle.b), Vec3d(triangle.c)};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d corner = corners[i] - Vec3d(ray.origin);
      across[i] = {glm::dot(corner, right), glm::dot(corner, up)};
      scale = std::max({scale, std::fabs(corner.x), std::fabs(corner.y), std::fabs(corner.z)});
    }
    for (Vec3d& corner : corners) corner -= Vec3d(ray.origin);
    const Vec3d normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d edge = corners[(i + 1) % 3] - corners[i];
      longest = std::max(longest, glm::dot(edge, edge));
    }
    const double facing = std::fabs(glm::dot(normal, direction));
    condition = facing > 0.0 ? longest / facing : std::numeric_limits<double>::infinity();
  }

  /// Distance across the ray from the ray to the edge that begins at corner i.
  [[nodiscard]] double to_edge(std::size_t i) const {
    const glm::dvec2 from = across[i];
    const glm::dvec2 edge = across[(i + 1) % 3] - from;
    const double squared = glm::dot(edge, edge);
    const double at = squared > 0.0 ? std::clamp(-glm::dot(from, edge) / squared, 0.0, 1.0) : 0.0;
    return glm::length(from + at * edge);
  }
  [[nodiscard]] double to_edges() const { return std::min({to_edge(0), to_edge(1), to_edge(2)}); }

  /// On which side of the line through two corners the third one lies, seen along the ray.
  [[nodiscard]] static double side(glm::dvec2 from, glm::dvec2 to, glm::dvec2 of) {
    return (to.x - from.x) * (of.y - from.y) - (to.y - from.y) * (of.x - from.x);
  }

  [[nodiscard]] bool contains_ray() const {
    int left = 0;
    int right = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double of_ray = side(across[i], across[(i + 1) % 3], {0.0, 0.0});
      left += of_ray > 0.0 ? 1 : 0;
      right += of_ray < 0.0 ? 1 : 0;
    }
    return left == 0 || right == 0;
  }

  [[nodiscard]] bool may_contain_ray() const { return contains_ray() || to_edges() <= rounding(); }

  /// A few ulps of the coordinates that both tests subtract first and compute with.
  [[nodiscard]] double rounding() const { return HitComparison::kFewUlps * float_ulp(scale); }

  std::array<glm::dvec2, 3> across;  ///< corners across the ray, which is the origin
  double scale = 0.0;      ///< largest coordinate of a corner relative to the ray's origin
  double condition = 0.0;  ///< longest edge squared over twice the area seen along the ray
};

}  // namespace

HitComparison::HitComparison(const std::filesystem::path& scene, const Config& config)
    : scene_(load_scene(scene).scene, config),
      embree_(scene_.scene.positions, scene_.scene.triangles),
      shader_(scene_.scene, kOneBounce, nullptr) {}

void HitComparison::random_rays(std::uint64_t count) {
  Random random(1);
  const Box& box = scene_.scene.bounds;
  RayPacket packet;
  for (std::uint64_t i = 0; i < count; i += kPacketSize) {
    packet.clear(kPacketSize);
    for (int lane = 0; lane < kPacketSize; ++lane) {
      Ray ray;
      for (int axis = 0; axis < 3; ++axis) {
        const float at = -0.1F + 1.2F * random.uniform();
        ray.origin[axis] = box.lo[axis] + at * (box.hi[axis] - box.lo[axis]);
      }
      const float z = 2.0F * random.uniform() - 1.0F;
      const float angle = 2.0F * std::numbers::pi_v<float> * random.uniform();
      const float radius = std::sqrt(std::max(0.0F, 1.0F - z * z));
      ray.direction = {radius * std::cos(angle), radius * std::sin(angle), z};
      ray.t_max = std::numeric_limits<float>::infinity();
      ray.tag.kind = RayKind::kReflection;
      packet.put(lane, ray);
    }
    trace_and_compare(packet, "random");
  }
}

void HitComparison::primary_and_secondary_rays(std::uint64_t count) {
  // Pictures of the shape 4 : 3 and of whole blocks of 4 x 4 pixels, each a little larger.
  auto height = static_cast<std::uint32_t>(
      std::ceil(std::sqrt(static_cast<double>(count) * 3.0 / 4.0) / 12.0) * 12.0);
  for (; tallies_["primary"].rays < count || tallies_["secondary"].rays < count; height += 12) {
    const std::uint32_t width = height / 3 * 4;
    for (std::uint32_t y = 0; y < height; y += 4) {
      for (std::uint32_t x = 0; x < width; x += 4) {
        RayPacket& packet = *pool_.acquire();
        for (std::uint32_t i = 0; i < kPacketSize; ++i) {
          packet.put(static_cast<int>(i),
                     primary_ray(scene_.scene.camera, width, height, x + i % 4, y + i / 4));
        }
        follow(packet, "primary");
      }
    }
  }
}

// The packet, what it spawns, and what that spawns.
void HitComparison::follow(RayPacket& packet, const std::string& kind) {
  trace_and_compare(packet, kind);
  PacketShading shading;
  shader_.shade(packet, shading);
  pool_.release(&packet);
  std::vector<RayPacket*> spawned;
  split_by_kind(shading.spawned, pool_, spawned);
  for (RayPacket* secondary : spawned) follow(*secondary, "secondary");
}

void HitComparison::trace_and_compare(RayPacket& packet, const std::string& kind) {
  TraceCounts counts;
  trace_packet(TraversalScheme::kMasked, scene_.tree, scene_.triangles, packet, nullptr, nullptr,
               counts);
  Tally& tally = tallies_[kind];
  for (LaneMask left = packet.active; left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    const auto i = static_cast<std::size_t>(lane);
    const Ray ray = packet.get(lane);
    ++tally.rays;
    if (packet.hit_triangle[i] != kNoHit) ++tally.hits;
    if (ray.tag.kind == RayKind::kShadow) {
      compare_shadow(ray, packet.hit_triangle[i], kind);
    } else {
      compare(ray, {packet.hit_triangle[i], packet.hit_t[i]}, kind);
    }
  }
}

void HitComparison::compare(const Ray& ray, const Hit& ours, const std::string& kind) {
  const Hit theirs = embree_.closest(ray);
  Tally& tally = tallies_[kind];
  if (ours.triangle == kNoHit && theirs.triangle == kNoHit) return;
  if (ours.triangle != theirs.triangle) {
    differ(ray, ours, theirs, kind);
    return;
  }
  const double difference = std::fabs(double{ours.t} - double{theirs.t});
  if (difference == 0.0) return;
  ++tally.inexact_t;
  const SeenTriangle seen(ray, scene_.triangles[ours.triangle]);
  const double ulps = difference / (seen.condition * float_ulp(seen.scale));
  tally.most_ulps = std::max(tally.most_ulps, ulps);
  if (ulps <= kFewUlps) return;
  ++tally.unexplained;
  list(ray, ours, theirs, kind, "t");
}

// The machine asks only whether something is hit, and so does Embree.
void HitComparison::compare_shadow(const Ray& ray, std::uint32_t triangle,
                                   const std::string& kind) {
  if ((triangle != kNoHit) == embree_.occluded(ray)) return;
  RayPacket packet;
  packet.clear(1);
  Ray closest = ray;
  closest.tag.kind = RayKind::kReflection;
  packet.put(0, closest);
  TraceCounts counts;
  trace_packet(TraversalScheme::kMasked, scene_.tree, scene_.triangles, packet, nullptr, nullptr,
               counts);
  differ(ray, {packet.hit_triangle[0], packet.hit_t[0]}, embree_.closest(ray), kind);
}

void HitComparison::differ(const Ray& ray, const Hit& ours, const Hit& theirs,
                           const std::string& kind) {
  const std::string why = explanation(ray, ours, theirs);
  Tally& tally = tallies_[kind];
  if (why.empty()) {
    ++tally.unexplained;
  } else {
    ++tally.explained[why];
  }
  list(ray, ours, theirs, kind, why.empty() ? "UNEXPLAINED" : why);
}

std::string HitComparison::explanation(const Ray& ray, const Hit& a, const Hit& b) const {
  const bool a_first = b.triangle == kNoHit || (a.triangle != kNoHit && a.t <= b.t);
  const Hit& near = a_first ? a : b;
  const Hit& far = a_first ? b : a;
  const SeenTriangle first(ray, scene_.triangles[near.triangle]);
  if (!first.may_contain_ray()) return {};
  if (far.triangle != kNoHit) {
    const SeenTriangle second(ray, scene_.triangles[far.triangle]);
    if (!second.may_contain_ray()) return {};
    const double room =
        std::max(first.condition * first.rounding(), second.condition * second.rounding());
    if (double{far.t} - double{near.t} <= room) {
      return share_a_corner(near.triangle, far.triangle) ? "shared edge or corner" : "overlap";
    }
  }
  return passes_a_silhouette(ray, near.triangle) ? "silhouette" : "";
}

// An edge within reach of the ray on whose other side, seen along the ray, the surface does not go
// on: a border of the mesh, or a fold.
bool HitComparison::passes_a_silhouette(const Ray& ray, std::uint32_t triangle) const {
  const SeenTriangle seen(ray, scene_.triangles[triangle]);
  for (std::size_t i = 0; i < 3; ++i) {
    if (seen.to_edge(i) <= seen.rounding() && !goes_on(ray, triangle, i)) return true;
  }
  return false;
}

bool HitComparison::goes_on(const Ray& ray, std::uint32_t triangle, std::size_t edge) const {
  const auto corners = [&](std::size_t index) {
    const TriangleRecord& record = scene_.triangles[index];
    return std::array{record.a, record.b, record.c};
  };
  const SeenTriangle seen(ray, scene_.triangles[triangle]);
  const Vec3 from = corners(triangle)[edge];
  const Vec3 to = corners(triangle)[(edge + 1) % 3];
  const glm::dvec2 seen_from = seen.across[edge];
  const glm::dvec2 seen_to = seen.across[(edge + 1) % 3];
  const double own_side = SeenTriangle::side(seen_from, seen_to, seen.across[(edge + 2) % 3]);
  for (std::size_t other = 0; other < scene_.triangles.size(); ++other) {
    const auto mate = corners(other);
    for (std::size_t i = 0; i < 3 && other != triangle; ++i) {
      const Vec3& p = mate[i];
      const Vec3& q = mate[(i + 1) % 3];
      if (!((p == from && q == to) || (p == to && q == from))) continue;
      const SeenTriangle seen_mate(ray, scene_.triangles[other]);
      const double side = SeenTriangle::side(seen_from, seen_to, seen_mate.across[(i + 2) % 3]);
      if (side * own_side < 0.0) return true;
    }
  }
  return false;
}

bool HitComparison::share_a_corner(std::uint32_t a, std::uint32_t b) const {
  const TriangleRecord& of_a = scene_.triangles[a];
  const TriangleRecord& of_b = scene_.triangles[b];
  for (const Vec3& p : {of_a.a, of_a.b, of_a.c}) {
    for (const Vec3& q : {of_b.a, of_b.b, of_b.c}) {
      if (p == q) return true;
    }
  }
  return false;
}

void HitComparison::list(const Ray& ray, const Hit& ours, const Hit& theirs,
                         const std::string& kind, const std::string& why) {
  std::vector<std::string>& lines = lists_[kind + ", " + why];
  if (lines.size() == kListed) return;
  const auto side = [&](const Hit& hit) {
    if (hit.triangle == kNoHit) return std::string("a miss");
    const SeenTriangle seen(ray, scene_.triangles[hit.triangle]);
    return fmt::format("triangle {} at t {} ({:.2g} ulps {} its edge, condition {:.2g})",
                       hit.triangle, hit.t, seen.to_edges() / float_ulp(seen.scale),
                       seen.contains_ray() ? "within" : "outside", seen.condition);
  };
  const auto vec = [](const Vec3& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); };
  lines.push_back(fmt::format("origin {} direction {}: {}; Embree: {}", vec(ray.origin),
                              vec(ray.direction), side(ours), side(theirs)));
}

std::string HitComparison::text() const {
  std::string text;
  for (const auto& [kind, tally] : tallies_) {
    text += fmt::format("{}: {} rays, {} hits, t differs in {} by at most {:.3g} ulps\n", kind,
                        tally.rays, tally.hits, tally.inexact_t, tally.most_ulps);
    for (const auto& [why, count] : tally.explained) text += fmt::format("  {}: {}\n", why, count);
    if (tally.unexplained != 0) text += fmt::format("  UNEXPLAINED: {}\n", tally.unexplained);
  }
  for (const auto& [title, lines] : lists_) {
    text += title + ", the first of them:\n";
    for (const std::string& line : lines) text += "  " + line + "\n";
  }
  return text;
}

}  // namespace sheaf::test
