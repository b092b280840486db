// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_builder.h"

namespace sheaf::test {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

TEST(LoadInstancing, SharedMeshIsPlacedByEachNode) {
  GltfBuilder file = one_triangle();
  file.add_root({{"mesh", 0}, {"translation", {0, 0, 5}}});
  const LoadedScene loaded = load(file);
  EXPECT_EQ(loaded.counts.instances, 2U);
  EXPECT_EQ(corners(loaded.scene), (std::vector<Vec3>{{0, 0, 0},
                                                      {1, 0, 0},
                                                      {0, 1, 0},  //
                                                      {0, 0, 5},
                                                      {1, 0, 5},
                                                      {0, 1, 5}}));
}

GltfBuilder instanced(const json& attributes, GltfBuilder file) {
  file.root["extensionsUsed"] = {kInstancing};
  file.root["extensionsRequired"] = {kInstancing};
  file.root["nodes"][0]["extensions"] = {{kInstancing, {{"attributes", attributes}}}};
  return file;
}

TEST(LoadInstancing, GpuInstancingMultipliesTheMesh) {
  GltfBuilder file = one_triangle();
  const int translation = file.add_accessor(std::vector<float>{0, 0, 0, 10, 0, 0}, kFloat, "VEC3");
  const int scale = file.add_accessor(std::vector<float>{1, 1, 1, 2, 2, 2}, kFloat, "VEC3");
  file.root["nodes"][0]["translation"] = {0, 0, 1};
  const LoadedScene loaded =
      load(instanced({{"TRANSLATION", translation}, {"SCALE", scale}}, file));
  EXPECT_EQ(loaded.counts.instances, 2U);
  EXPECT_EQ(corners(loaded.scene), (std::vector<Vec3>{{0, 0, 1},
                                                      {1, 0, 1},
                                                      {0, 1, 1},  //
                                                      {10, 0, 1},
                                                      {12, 0, 1},
                                                      {10, 2, 1}}));
}

TEST(LoadInstancing, QuantizedRotationIsNormalized) {
  GltfBuilder file = one_triangle();
  // 90 degrees about z; 90/127 is not the square root of one half.
  const int rotation =
      file.add_accessor(std::vector<std::int8_t>{0, 0, 90, 90}, kByte, "VEC4", true);
  const std::vector<Vec3> c = corners(load(instanced({{"ROTATION", rotation}}, file)).scene);
  EXPECT_LT(glm::distance(c[1], Vec3(0, 1, 0)), 1e-6F);
  EXPECT_LT(glm::distance(c[2], Vec3(-1, 0, 0)), 1e-6F);
}

TEST(LoadInstancing, AttributesOfDifferentCountsAreRefused) {
  GltfBuilder file = one_triangle();
  const int two = file.add_accessor(std::vector<float>(6), kFloat, "VEC3");
  const int three = file.add_accessor(std::vector<float>(9), kFloat, "VEC3");
  expect_refused(instanced({{"TRANSLATION", two}, {"SCALE", three}}, file),
                 {"/nodes/0", kInstancing, "2", "3"});
}

}  // namespace
}  // namespace sheaf::test
