// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sheaf {
namespace {

TEST(PrimaryRay, OddPicturesMiddlePixelLooksForward) {
  Camera camera;
  camera.position = Vec3(1, 2, 3);
  const Ray ray = primary_ray(camera, 3, 3, 1, 1);
  EXPECT_EQ(ray.origin, camera.position);
  EXPECT_EQ(ray.direction, camera.forward);
  EXPECT_EQ(ray.t_max, std::numeric_limits<float>::infinity());
  EXPECT_EQ(ray.weight, Vec3(1));
  EXPECT_EQ(ray.tag.kind, RayKind::kPrimary);
  EXPECT_EQ(ray.tag.depth, 0);
}

TEST(PrimaryRay, RowZeroIsTheTopAndColumnZeroTheLeft) {
  const Ray ray = primary_ray(Camera(), 640, 480, 0, 0);
  EXPECT_LT(ray.direction.x, 0.0F);
  EXPECT_GT(ray.direction.y, 0.0F);
}

TEST(PrimaryRay, VerticalFieldOfViewHoldsWhateverTheAspect) {
  Camera camera;
  camera.half_height = 1.0F;
  for (const std::uint32_t width : {100U, 1000U}) {
    const Ray top = primary_ray(camera, width, 100, 0, 0);
    EXPECT_NEAR(top.direction.y / -top.direction.z, 0.99F, 1e-5F);
    EXPECT_NEAR(top.direction.x / top.direction.z,
                (1.0F - 1.0F / static_cast<float>(width)) * static_cast<float>(width) / 100.0F,
                1e-4F);
  }
}

TEST(PrimaryRay, DirectionsAreUnit) {
  Camera camera;
  camera.half_height = 10.0F;
  for (std::uint32_t x = 0; x < 64; ++x) {
    EXPECT_NEAR(glm::length(primary_ray(camera, 64, 48, x, x / 2).direction), 1.0F, 1e-6F);
  }
}

TEST(PrimaryRay, IdentityIsThePixels) {
  const Ray ray = primary_ray(Camera(), 10, 5, 3, 2);
  EXPECT_EQ(ray.tag.pixel, 23U);
  EXPECT_EQ(ray.tag.id, primary_ray_id(23));
}

TEST(PrimaryRay, OrthographicRaysAreParallelAndSpanTheHeight) {
  Camera camera;
  camera.orthographic = true;
  camera.half_height = 2.0F;
  const Ray top = primary_ray(camera, 4, 2, 0, 0);
  const Ray bottom = primary_ray(camera, 4, 2, 3, 1);
  EXPECT_EQ(top.direction, camera.forward);
  EXPECT_EQ(top.origin, Vec3(-3, 1, 0));
  EXPECT_EQ(bottom.origin, Vec3(3, -1, 0));
}

}  // namespace
}  // namespace sheaf
