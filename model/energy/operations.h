// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "energy/coefficients.h"

namespace sheaf {

/// Floating-point operations of 32 bits that one event takes.
struct Operations {
  double add = 0, multiply = 0, compare = 0, divide = 0, square_root = 0;

  [[nodiscard]] constexpr double picojoule() const {
    return add * Coefficients::fp32_add.value + multiply * Coefficients::fp32_multiply.value +
           compare * Coefficients::fp32_compare.value + divide * Coefficients::fp32_divide.value +
           square_root * Coefficients::fp32_square_root.value;
  }
};

// Counted in the kernels that the model runs; subtractions count as additions, minima and maxima as
// comparisons.

/// A camera ray (scene/camera.cpp): point on the picture plane, then its direction, normalised.
inline constexpr Operations kCameraRay{.add = 8, .multiply = 12, .divide = 1, .square_root = 1};

/// A ray's set-up (traversal/ray_setup-inl.h): for each axis reach, error, two origins, 1 / d and
/// the interval in the tree's box; then the longest axis and the shear.
inline constexpr Operations kRaySetUp{.add = 24, .multiply = 12, .compare = 13, .divide = 6};

/// A ray at an inner node (traversal/masked-inl.h): both distances, both intervals.
inline constexpr Operations kNodeStep{.add = 2, .multiply = 2, .compare = 4};

/// A whole pass at an inner node (traversal/interval-inl.h): two products of ranges.
inline constexpr Operations kIntervalStep{.add = 4, .multiply = 8, .compare = 16};

/// A ray clipped to a leaf's box (traversal/interval-inl.h).
inline constexpr Operations kLeafClip{.add = 6, .multiply = 6, .compare = 8};

/// A ray against a triangle (geometry/watertight.h) up to the signs of the edge functions.
inline constexpr Operations kTriangleTest{.add = 18, .multiply = 15, .compare = 6};

/// A hit's surface and emission (shading/shader.cpp).
inline constexpr Operations kSurface{
    .add = 31, .multiply = 42, .compare = 2, .divide = 2, .square_root = 2};

// A ray spawned at it (shading/spawn.cpp): direction, weight, moved origin.
inline constexpr Operations kReflection{
    .add = 12, .multiply = 25, .compare = 4, .divide = 1, .square_root = 1};
inline constexpr Operations kRefraction{
    .add = 19, .multiply = 36, .compare = 6, .divide = 4, .square_root = 2};
inline constexpr Operations kShadow{
    .add = 17, .multiply = 38, .compare = 5, .divide = 2, .square_root = 2};

// A ray's key (sorting/): longest axis and two face coordinates; a voxel of the scene's box; an
// octant of it; the distance to one anchor.
inline constexpr Operations kFaceKey{.multiply = 2, .compare = 3, .divide = 1};
inline constexpr Operations kVoxelKey{.add = 3, .multiply = 3};
inline constexpr Operations kOctantKey{.compare = 3};
inline constexpr Operations kAnchorKey{.add = 5, .multiply = 3, .compare = 1};

}  // namespace sheaf
