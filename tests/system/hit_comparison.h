// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "shading/packet_shader.h"
#include "support/embree_oracle.h"
#include "system/prepared_scene.h"

namespace sheaf::test {

/// Traces rays in masked packets as the machine does and holds every hit against Embree's.
///
/// Two distances agree if they differ by at most kFewUlps float ulps of the largest of t and the
/// coordinates (relative to the ray's origin) of the triangles' corners: both tests subtract the
/// origin from the corners in single precision first, so that their error is relative to those.
///
/// Two answers that name different triangles, or of which one is a miss, are explained only if both
/// are right for a ray that is moved by rounding: the ray passes each triangle that is named within
/// kFewUlps ulps of the corners (in the plane across the ray), in double precision; and if both
/// name one, the distances agree. So the point that was hit lies on both: on a shared edge or
/// vertex, where two triangles cross or overlap, or, with a miss, on the border of the mesh.
class HitComparison {
 public:
  static constexpr float kFewUlps = 4.0F;

  struct Tally {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    std::uint64_t inexact_t = 0;    ///< same triangle, t differs but agrees
    float most_ulps = 0.0F;         ///< largest difference of t between equal triangles
    std::uint64_t explained = 0;    ///< other triangle, explained
    std::uint64_t shared_edge = 0;  ///< of these: triangles that have a corner in common
    std::uint64_t overlap = 0;      ///< of these: no corner in common, both at the same point
    std::uint64_t border = 0;       ///< of these: one a miss
    std::uint64_t unexplained = 0;
  };

  explicit HitComparison(const std::filesystem::path& scene);

  /// Rays from points in and around the scene's box in all directions.
  void random_rays(std::uint64_t count);
  /// At least `count` camera rays, and at least as many rays spawned by the shader at what the
  /// camera rays and their successors hit.
  void primary_and_secondary_rays(std::uint64_t count);

  /// By kind: "random", "primary", "secondary" (reflection, refraction), "shadow".
  [[nodiscard]] const std::map<std::string, Tally>& tallies() const { return tallies_; }
  void print(std::ostream& out) const;

 private:
  struct Answer {
    std::uint32_t triangle = kNoHit;
    float t = 0.0F;
  };
  void trace_and_compare(RayPacket& packet);
  void spawn_and_compare(RayPacket& packet, std::uint32_t levels);
  void compare(const Ray& ray, const Answer& ours, Tally& tally);
  void compare_shadow(const Ray& ray, bool occluded, Tally& tally);
  [[nodiscard]] std::string why_different(const Ray& ray, const Answer& a, const Answer& b) const;
  void list(const Ray& ray, const Answer& ours, const Answer& theirs, const std::string& why);

  PreparedScene scene_;
  EmbreeOracle embree_;
  PacketShader shader_;
  std::map<std::string, Tally> tallies_;
  std::map<std::string, std::vector<std::string>> lists_;  ///< the first few of each explanation
};

}  // namespace sheaf::test
