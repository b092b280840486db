// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "gltf_builder.h"
#include "scene/camera.h"

namespace sheaf::test {
namespace {

GltfBuilder with_two_cameras() {
  GltfBuilder file = one_triangle();
  file.root["cameras"] = json::array(
      {{{"type", "perspective"}, {"name", "lens"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}},
       {{"type", "orthographic"},
        {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 10}}}}});
  const double h = std::sqrt(0.5);
  file.add_root({{"camera", 0}, {"name", "front"}, {"translation", {0, 0, 5}}});
  file.add_root(
      {{"camera", 1}, {"name", "side"}, {"rotation", {0, h, 0, h}}, {"scale", {2, 3, 4}}});
  return file;
}

void expect_orthonormal(const Camera& c) {
  EXPECT_NEAR(glm::length(c.right), 1.0F, 1e-6F);
  EXPECT_NEAR(glm::length(c.up), 1.0F, 1e-6F);
  EXPECT_NEAR(glm::length(c.forward), 1.0F, 1e-6F);
  EXPECT_LT(glm::distance(glm::cross(c.right, c.up), -c.forward), 1e-6F);
}

TEST(LoadCamera, TheFirstCameraIsUsed) {
  const Camera c = load(with_two_cameras()).scene.camera;
  EXPECT_EQ(c.position, Vec3(0, 0, 5));
  EXPECT_EQ(c.forward, Vec3(0, 0, -1));
  EXPECT_EQ(c.right, Vec3(1, 0, 0));
  EXPECT_FALSE(c.orthographic);
  EXPECT_FLOAT_EQ(c.half_height, std::tan(0.5F));
}

TEST(LoadCamera, NamePicksANodeOrACamera) {
  const Camera side = load(with_two_cameras(), {.camera_name = "side"}).scene.camera;
  EXPECT_TRUE(side.orthographic);
  EXPECT_EQ(side.half_height, 3.0F);
  EXPECT_LT(glm::distance(side.forward, Vec3(-1, 0, 0)), 1e-6F);
  expect_orthonormal(side);
  EXPECT_EQ(load(with_two_cameras(), {.camera_name = "lens"}).scene.camera.position, Vec3(0, 0, 5));
}

TEST(LoadCamera, UnknownNameIsAUsageErrorThatListsTheOthers) {
  try {
    (void)load(with_two_cameras(), {.camera_name = "back"});
    FAIL() << "loaded";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_NE(std::string(error.what()).find("\"front\", \"side\""), std::string::npos);
  }
}

TEST(LoadCamera, ASceneWithoutCameraIsFramed) {
  GltfBuilder file = one_triangle();
  file.root["nodes"][0]["scale"] = {100, 10, 1};
  file.root["nodes"][0]["translation"] = {1000, 0, 0};
  const LoadedScene loaded = load(file);
  const Camera& c = loaded.scene.camera;
  expect_orthonormal(c);
  EXPECT_GT(c.position.y, loaded.scene.bounds.hi.y);
  // Every corner of the bounds is in the picture: within the cone of the field of view.
  for (int corner = 0; corner < 8; ++corner) {
    const Box& b = loaded.scene.bounds;
    const Vec3 p((corner & 1 ? b.hi : b.lo).x, (corner & 2 ? b.hi : b.lo).y,
                 (corner & 4 ? b.hi : b.lo).z);
    const Vec3 to = p - c.position;
    const float depth = glm::dot(to, c.forward);
    EXPECT_GT(depth, 0.0F);
    EXPECT_LT(std::abs(glm::dot(to, c.up)), depth * c.half_height);
    EXPECT_LT(std::abs(glm::dot(to, c.right)), depth * c.half_height);
  }
}

TEST(LoadCamera, ConfiguredPositionLooksAtTheCentre) {
  const Camera c =
      load(with_two_cameras(), {.camera_position = Vec3(0.5F, 0.5F, 9), .camera_yfov = 90.0F})
          .scene.camera;
  EXPECT_EQ(c.position, Vec3(0.5F, 0.5F, 9));
  EXPECT_EQ(c.forward, Vec3(0, 0, -1));
  EXPECT_FLOAT_EQ(c.half_height, 1.0F);
}

TEST(LoadCamera, ConfiguredTargetTurnsTheScenesCamera) {
  const Camera c = load(with_two_cameras(), {.camera_look_at = Vec3(5, 0, 5)}).scene.camera;
  EXPECT_EQ(c.position, Vec3(0, 0, 5));
  EXPECT_EQ(c.forward, Vec3(1, 0, 0));
  EXPECT_FLOAT_EQ(c.half_height, std::tan(0.5F));
}

TEST(LoadCamera, LookingStraightDownHasAnUp) {
  const Camera c =
      load(one_triangle(), {.camera_position = Vec3(0, 9, 0), .camera_look_at = Vec3(0)})
          .scene.camera;
  EXPECT_EQ(c.forward, Vec3(0, -1, 0));
  expect_orthonormal(c);
}

}  // namespace
}  // namespace sheaf::test
