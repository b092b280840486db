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
/// Both first subtract the ray's origin from a triangle's corners and compute in single precision
/// from there, so that an error of a few ulps of the largest of these coordinates, here "a
/// rounding", is in the nature of either. A triangle's plane follows from its edges, so that its
/// distance along the ray is uncertain by a rounding times
///   condition = longest edge squared / twice the area as seen along the ray,
/// which is about 1 for a regular triangle that faces the ray and large for slivers and at grazing
/// angles. Distances agree if they differ by no more than that.
///
/// Where the answers name different triangles, or one is a miss, each triangle named must contain
/// the ray in double precision or miss it by a rounding, and
///   shared edge or corner   the distances agree, and the triangles have a corner in common
///   overlap                 the distances agree, but they have none in common: surfaces that cross
///                           or lie upon each other (of equal t, Sheaf takes the lower number)
///   silhouette              the ray passes an edge of the nearer triangle by a rounding, and the
///                           surface does not go on behind that edge, so that it may miss it
/// Any other difference is unexplained. A ray that slips through between two neighbours is one.
class HitComparison {
 public:
  static constexpr double kFewUlps = 6.0;  ///< a rounding; 4.9 were measured

  static constexpr int kPacketSize = 16;

  struct Tally {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    std::uint64_t inexact_t = 0;  ///< same triangle, not the same t
    double most_ulps = 0.0;       ///< largest difference of t of these, over condition, in ulps
    std::map<std::string, std::uint64_t> explained;
    std::uint64_t unexplained = 0;
  };

  HitComparison(const std::filesystem::path& scene, const Config& config);

  /// Rays from points in and around the scene's box in all directions.
  void random_rays(std::uint64_t count);
  /// At least `count` camera rays, and at least as many that the shader spawned at their hits.
  void primary_and_secondary_rays(std::uint64_t count);

  /// By kind: "random", "primary" and "secondary".
  [[nodiscard]] const std::map<std::string, Tally>& tallies() const { return tallies_; }
  /// Tallies, and the first few rays of each explanation.
  [[nodiscard]] std::string text() const;

 private:
  using Hit = EmbreeOracle::Hit;
  void follow(RayPacket& packet, const std::string& kind);
  void trace_and_compare(RayPacket& packet, const std::string& kind);
  void compare(const Ray& ray, const Hit& ours, const std::string& kind);
  void compare_shadow(const Ray& ray, std::uint32_t triangle, const std::string& kind);
  void differ(const Ray& ray, const Hit& ours, const Hit& theirs, const std::string& kind);
  [[nodiscard]] std::string explanation(const Ray& ray, const Hit& a, const Hit& b) const;
  [[nodiscard]] bool passes_a_silhouette(const Ray& ray, std::uint32_t triangle) const;
  [[nodiscard]] bool goes_on(const Ray& ray, std::uint32_t triangle, std::size_t edge) const;
  [[nodiscard]] bool share_a_corner(std::uint32_t a, std::uint32_t b) const;
  void list(const Ray& ray, const Hit& ours, const Hit& theirs, const std::string& kind,
            const std::string& why);

  PreparedScene scene_;
  EmbreeOracle embree_;
  PacketShader shader_;
  PacketPool pool_{kPacketSize};
  std::map<std::string, Tally> tallies_;
  std::map<std::string, std::vector<std::string>> lists_;
};

}  // namespace sheaf::test
