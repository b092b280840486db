// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "geometry/ray.h"

namespace sheaf::test {

/// What Embree 3 says about a ray: an oracle that shares no code with Sheaf.
class EmbreeOracle {
 public:
  struct Hit {
    std::uint32_t triangle = kNoHit;
    float t = 0.0F;
  };

  /// Robust: watertight and conservative, as an oracle must be. Fast: Embree as it comes, for
  /// benchmarks.
  enum class Mode : std::uint8_t { kRobust, kFast };

  /// Throws std::runtime_error on failure.
  EmbreeOracle(std::span<const Vec3> positions,
               std::span<const std::array<std::uint32_t, 3>> triangles, Mode mode = Mode::kRobust);
  ~EmbreeOracle();
  EmbreeOracle(const EmbreeOracle&) = delete;
  EmbreeOracle& operator=(const EmbreeOracle&) = delete;

  /// The closest hit in 0 <= t <= t_max.
  [[nodiscard]] Hit closest(const Ray& ray) const;
  /// Whether anything is hit before t_max.
  [[nodiscard]] bool occluded(const Ray& ray) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace sheaf::test
