// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// No ray slips through a closed mesh, however well it aims at edges and corners.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "stability/catalogue.h"
#include "stability/extreme_meshes.h"
#include "stability/mesh_scene.h"

namespace sheaf::stability {
namespace {

/// Sends packets at a closed mesh and counts the rays that get through to its other side.
class LeakMeasurement {
 public:
  explicit LeakMeasurement(const ClosedMesh& source) : source_(source), scene_(source.mesh) {}

  std::vector<Finding> run(int num_rays) {
    prepare();
    Random random(31);
    Vec3 outer;
    for (int i = 0; i < num_rays / (2 * kLanes); ++i) {
      const Vec3 inner = inside(random);
      send(
          inner, [&] { return on_edge(random); }, kInside, from_inside_);
      if (i % 5 == 0) {
        send(
            inner, [&] { return Vec3d(inner) + Vec3d(random_direction(random)); }, kInside,
            random_);
      }
      if (i % 4 == 0) find_facing(outer = outside(random));
      send(
          outer, [&] { return facing_edge(random); }, kOutside, from_outside_);
    }
    const char* const why =
        "triangles that share an edge compute the same edge function for it (watertight.h)";
    return {from_inside_.finding("rays at edges and corners that leak out", why),
            from_outside_.finding("rays at edges and corners that leak in", why),
            random_.finding("random rays that leak out", why)};
  }

 private:
  Vec3 inside(Random& random) const {
    if (random.below(2) == 0) {
      const float radius = source_.inner * random.uniform();
      return source_.centre + radius * random_direction(random);
    }
    // A whole number of units off the centre, which lies on a plane of the grid if there is one.
    Vec3 origin = source_.centre;
    const float step = source_.inner / 6.0F;
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis] += step * (static_cast<float>(random.below(7)) - 3.0F);
    }
    return origin;
  }
  Vec3 outside(Random& random) const {
    Vec3 direction = random_direction(random);
    if (source_.level) direction = glm::normalize(Vec3(direction.x, 0.0F, direction.z));
    return source_.centre + source_.outer * direction;
  }
  /// On an edge; one time in three a corner. In doubles, for far from the origin floats are so far
  /// apart that hardly any lies on an edge.
  Vec3d on_edge(Random& random) const {
    const auto& t = scene_.mesh.triangles[random.below(scene_.mesh.triangles.size())];
    const Vec3d a(scene_.mesh.positions[t[random.below(3)]]);
    const Vec3d b(scene_.mesh.positions[t[random.below(3)]]);
    return a + double{random.uniform()} * (b - a);
  }
  /// Corners whose triangles all turn towards the origin, which then sees no edge between two of
  /// them as part of the outline.
  void find_facing(const Vec3& origin) {
    const double margin = 0.1 * double{source_.outer};
    std::fill(faces_.begin(), faces_.end(), true);
    for (std::size_t i = 0; i < scene_.records.size(); ++i) {
      if (height_over(static_cast<std::uint32_t>(i), origin) > margin) continue;
      for (const std::uint32_t corner : welded_[i]) faces_[corner] = false;
    }
  }
  /// On an edge that faces the origin of find_facing(), corners included.
  Vec3d facing_edge(Random& random) const {
    for (;;) {
      const std::size_t i = random.below(scene_.records.size());
      const std::size_t p = random.below(3);
      const std::size_t q = random.below(3);
      if (!faces_[welded_[i][p]] || !faces_[welded_[i][q]]) continue;
      const Vec3d from(scene_.mesh.positions[scene_.mesh.triangles[i][p]]);
      const Vec3d to(scene_.mesh.positions[scene_.mesh.triangles[i][q]]);
      return from + double{random.uniform()} * (to - from);
    }
  }

  /// Unit normals, and corners numbered by position.
  void prepare() {
    std::map<std::array<float, 3>, std::uint32_t> numbers;
    for (const TriangleRecord& t : scene_.records) {
      const Vec3d normal = glm::cross(Vec3d(t.b) - Vec3d(t.a), Vec3d(t.c) - Vec3d(t.a));
      const bool inwards = glm::dot(normal, Vec3d(t.a) - Vec3d(source_.centre)) < 0.0;
      outward_.push_back((inwards ? -normal : normal) / glm::length(normal));
      std::array<std::uint32_t, 3> corners{};
      std::size_t k = 0;
      for (const Vec3& p : {t.a, t.b, t.c}) {
        const auto next = static_cast<std::uint32_t>(numbers.size());
        corners[k++] = numbers.try_emplace({p.x, p.y, p.z}, next).first->second;
      }
      welded_.push_back(corners);
    }
    faces_.resize(numbers.size());
  }

  /// Sends a packet from one origin. A ray leaks if it meets nothing, or the mesh from the side
  /// that is turned away from the origin: from outside, the wall behind.
  void send(const Vec3& origin, const auto& target, double outside, Failures& leaks) {
    RayPacket packet;
    packet.clear(kLanes);
    for (int lane = 0; lane < kLanes; ++lane) {
      packet.put(lane, make_ray(origin, Vec3(glm::normalize(target() - Vec3d(origin)))));
    }
    const auto scheme = kTraversalSchemes[num_packets_++ % kTraversalSchemes.size()];
    TraceCounts counts;
    trace_packet(scheme, scene_.tree, scene_.records, packet, nullptr, nullptr, counts);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t met = packet.hit_triangle[lane];
      const bool right = met != kNoHit && outside * height_over(met, origin) > 0.0;
      leaks.check(right, [&] { return describe(packet.get(static_cast<int>(lane))); });
    }
  }
  /// Over the plane of a triangle; negative inside the mesh.
  double height_over(std::uint32_t triangle, const Vec3& point) const {
    return glm::dot(outward_[triangle], Vec3d(point) - Vec3d(scene_.records[triangle].a));
  }

  static constexpr int kLanes = 16;
  static constexpr double kInside = -1.0;
  static constexpr double kOutside = 1.0;
  const ClosedMesh& source_;
  const MeshScene scene_;
  std::vector<Vec3d> outward_;
  std::vector<std::array<std::uint32_t, 3>> welded_;
  std::vector<bool> faces_;
  std::size_t num_packets_ = 0;
  Failures from_inside_, from_outside_, random_;
};

}  // namespace

std::vector<StabilityCase> leak_cases() {
  // Together 1.4e7 rays at edges and corners.
  constexpr int kRays = 2'000'000;
  std::vector<StabilityCase> cases;
  for (const ClosedMesh& mesh : closed_meshes()) {
    cases.push_back({"leaks", mesh.name, mesh.extreme, [mesh](const Effort& effort) {
                       return LeakMeasurement(mesh).run(effort.trials(kRays));
                     }});
  }
  return cases;
}

}  // namespace sheaf::stability
