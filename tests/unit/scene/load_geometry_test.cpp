// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_builder.h"

namespace sheaf::test {
namespace {

TEST(LoadGeometry, OneTriangleComesThroughUnchanged) {
  const Scene scene = load(one_triangle()).scene;
  EXPECT_EQ(corners(scene), (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(scene.bounds.lo, Vec3(0, 0, 0));
  EXPECT_EQ(scene.bounds.hi, Vec3(1, 1, 0));
  EXPECT_EQ(scene.triangle_material.size(), 1U);
}

TEST(LoadGeometry, HierarchyOfTrsAndMatrixIsFlattened) {
  GltfBuilder file = one_triangle();
  // child: translate (1,2,3), turned 90 degrees about z; parent: matrix that doubles and moves by
  // x 10.
  const double h = std::sqrt(0.5);
  file.root["nodes"] = json::array(
      {{{"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1}}, {"children", {1}}},
       {{"mesh", 0},
        {"translation", {1, 2, 3}},
        {"rotation", {0, 0, h, h}},
        {"scale", {3, 1, 1}}}});
  const std::vector<Vec3> c = corners(load(file).scene);
  EXPECT_LT(glm::distance(c[0], Vec3(12, 4, 6)), 1e-5F);
  EXPECT_LT(glm::distance(c[1], Vec3(12, 10, 6)), 1e-5F);
  EXPECT_LT(glm::distance(c[2], Vec3(10, 4, 6)), 1e-5F);
}

TEST(LoadGeometry, PositionsAreTransformedInDoubleAndRoundedOnce) {
  GltfBuilder file = one_triangle();
  // The parent's and the child's offsets cancel; in single precision 1 + 1e9 - 1e9 would be 0.
  file.root["nodes"] = json::array({{{"translation", {1e9, 0, 0}}, {"children", {1}}},
                                    {{"mesh", 0}, {"translation", {-1e9, 0, 0}}}});
  EXPECT_EQ(corners(load(file).scene)[1], Vec3(1, 0, 0));
}

TEST(LoadGeometry, NegativeScaleKeepsFrontAndNormal) {
  GltfBuilder file;
  const int positions = file.add_accessor(triangle_positions(), kFloat, "VEC3");
  const int normals =
      file.add_accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3");
  file.add_mesh({{"POSITION", positions}, {"NORMAL", normals}});
  file.add_root({{"mesh", 0}, {"scale", {-1, 1, 1}}});
  file.add_root({{"mesh", 0}, {"scale", {1, 1, -1}}});
  file.add_root({{"mesh", 0}, {"scale", {-1, -1, -1}}});
  const Scene scene = load(file).scene;
  const std::vector<Vec3> expected{{0, 0, 1}, {0, 0, -1}, {0, 0, -1}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(winding_normal(scene, i), expected[i]) << i;
    for (const std::uint32_t v : scene.triangles[i]) EXPECT_EQ(scene.normals[v], expected[i]) << i;
  }
}

TEST(LoadGeometry, NormalsFollowTheInverseTranspose) {
  GltfBuilder file;
  const int positions = file.add_accessor(triangle_positions(), kFloat, "VEC3");
  const float h = std::sqrt(0.5F);
  const int normals =
      file.add_accessor(std::vector<float>{h, h, 0, h, h, 0, h, h, 0}, kFloat, "VEC3");
  file.add_root({{"mesh", file.add_mesh({{"POSITION", positions}, {"NORMAL", normals}})},
                 {"scale", {2, 1, 1}}});
  const Scene scene = load(file).scene;
  EXPECT_LT(glm::distance(scene.normals[0], glm::normalize(Vec3(0.5F, 1, 0))), 1e-6F);
}

TEST(LoadGeometry, MissingNormalsAreMadeFlat) {
  GltfBuilder file;
  // Two triangles that share an edge and stand at a right angle.
  const int positions =
      file.add_accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, kFloat, "VEC3");
  const int indices =
      file.add_accessor(std::vector<std::uint16_t>{0, 1, 2, 1, 0, 3}, kUnsignedShort, "SCALAR");
  file.add_root({{"mesh", file.add_mesh({{"POSITION", positions}}, indices)}});
  const Scene scene = load(file).scene;
  ASSERT_EQ(scene.positions.size(), 6U);
  for (std::size_t i = 0; i < 2; ++i) {
    for (const std::uint32_t v : scene.triangles[i]) {
      EXPECT_EQ(scene.normals[v], winding_normal(scene, i));
    }
  }
  EXPECT_NE(scene.normals[scene.triangles[0][0]], scene.normals[scene.triangles[1][0]]);
}

TEST(LoadGeometry, NormalsOfNoLengthAreReplacedByTheTriangles) {
  GltfBuilder file;
  const int positions = file.add_accessor(triangle_positions(), kFloat, "VEC3");
  const int normals =
      file.add_accessor(std::vector<float>{0, 0, 0, 0, 1, 0, 0, 1, 0}, kFloat, "VEC3");
  const int indices =
      file.add_accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 1}, kUnsignedByte, "SCALAR");
  file.add_root({{"mesh", file.add_mesh({{"POSITION", positions}, {"NORMAL", normals}})}});
  const Scene scene = load(file).scene;
  EXPECT_EQ(scene.normals[0], Vec3(0, 0, 1));
  EXPECT_EQ(scene.normals[1], Vec3(0, 1, 0));
  // Shared by two triangles of opposite sides, the sum has no direction either.
  file.root["meshes"][0]["primitives"][0]["indices"] = indices;
  EXPECT_EQ(load(file).scene.normals[0], Vec3(0, 1, 0));
}

TEST(LoadGeometry, ZeroScaleKeepsTheTriangleAndMakesUnitNormals) {
  GltfBuilder file = one_triangle();
  file.root["nodes"][0]["scale"] = {0, 0, 0};
  const Scene scene = load(file).scene;
  ASSERT_EQ(scene.triangles.size(), 1U);
  EXPECT_EQ(glm::length(scene.normals[0]), 1.0F);
}

TEST(LoadGeometry, SharedVerticesStaySharedAndUnusedOnesAreDropped) {
  GltfBuilder file;
  const int positions = file.add_accessor(
      std::vector<float>{9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 7, 7, 7}, kFloat, "VEC3");
  const int normals = file.add_accessor(std::vector<float>(18, 1.0F), kFloat, "VEC3");
  const int indices =
      file.add_accessor(std::vector<std::uint32_t>{1, 2, 3, 1, 3, 4}, kUnsignedInt, "SCALAR");
  file.add_root({{"mesh", file.add_mesh({{"POSITION", positions}, {"NORMAL", normals}}, indices)}});
  const Scene scene = load(file).scene;
  EXPECT_EQ(scene.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(scene.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_EQ(scene.bounds.hi, Vec3(1, 1, 0));
}

TEST(LoadGeometry, EveryIndexTypeIsRead) {
  for (const int type : {kUnsignedByte, kUnsignedShort, kUnsignedInt}) {
    GltfBuilder file;
    const int positions = file.add_accessor(triangle_positions(), kFloat, "VEC3");
    int indices = 0;
    if (type == kUnsignedByte) {
      indices = file.add_accessor(std::vector<std::uint8_t>{2, 0, 1}, type, "SCALAR");
    } else if (type == kUnsignedShort) {
      indices = file.add_accessor(std::vector<std::uint16_t>{2, 0, 1}, type, "SCALAR");
    } else {
      indices = file.add_accessor(std::vector<std::uint32_t>{2, 0, 1}, type, "SCALAR");
    }
    file.add_root({{"mesh", file.add_mesh({{"POSITION", positions}}, indices)}});
    EXPECT_EQ(corners(load(file).scene), (std::vector<Vec3>{{0, 1, 0}, {0, 0, 0}, {1, 0, 0}}))
        << type;
  }
}

TEST(LoadGeometry, SparseAccessorReplacesElements) {
  GltfBuilder file = one_triangle();
  const int indices = file.add_view(std::vector<std::uint16_t>{1});
  const int values = file.add_view(std::vector<float>{5, 6, 7});
  file.root["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
      {"values", {{"bufferView", values}}}};
  EXPECT_EQ(corners(load(file).scene), (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 1, 0}}));
  file.root["accessors"][0].erase("bufferView");
  EXPECT_EQ(corners(load(file).scene), (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 0, 0}}));
}

TEST(LoadGeometry, InterleavedAttributesAreTakenApart) {
  GltfBuilder file;
  const int view = file.add_view(std::vector<float>{0, 0, 0, 0, 0, 1,  //
                                                    1, 0, 0, 0, 0, 1,  //
                                                    0, 1, 0, 0, 0, 1},
                                 24);
  const int positions = file.add_accessor_on(view, kFloat, "VEC3", 3);
  const int normals = file.add_accessor_on(view, kFloat, "VEC3", 3);
  file.root["accessors"][normals]["byteOffset"] = 12;
  file.add_root({{"mesh", file.add_mesh({{"POSITION", positions}, {"NORMAL", normals}})}});
  const Scene scene = load(file).scene;
  EXPECT_EQ(corners(scene), (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(scene.normals, std::vector<Vec3>(3, Vec3(0, 0, 1)));
}

/// Positions of the given component type, padded to a stride of 4 or 8 as the format demands; the
/// largest and the smallest values are there.
template <typename T>
std::vector<Vec3> load_quantized(int component_type, bool normalized) {
  constexpr T kMin = std::numeric_limits<T>::min();
  constexpr T kMax = std::numeric_limits<T>::max();
  GltfBuilder file;
  const int view = file.add_view(std::vector<T>{kMin, 0, 0, 0, kMax, 0, 0, 0, 0, kMax, kMin, 0},
                                 static_cast<int>(4 * sizeof(T)));
  const int positions = file.add_accessor_on(view, component_type, "VEC3", 3, normalized);
  file.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  file.add_root({{"mesh", file.add_mesh({{"POSITION", positions}})}});
  return corners(load(file).scene);
}

TEST(LoadGeometry, QuantizedPositionsOfEveryType) {
  using Corners = std::vector<Vec3>;
  EXPECT_EQ(load_quantized<std::int8_t>(kByte, false),
            (Corners{{-128, 0, 0}, {127, 0, 0}, {0, 127, -128}}));
  EXPECT_EQ(load_quantized<std::uint8_t>(kUnsignedByte, false),
            (Corners{{0, 0, 0}, {255, 0, 0}, {0, 255, 0}}));
  EXPECT_EQ(load_quantized<std::int16_t>(kShort, false),
            (Corners{{-32768, 0, 0}, {32767, 0, 0}, {0, 32767, -32768}}));
  EXPECT_EQ(load_quantized<std::uint16_t>(kUnsignedShort, false),
            (Corners{{0, 0, 0}, {65535, 0, 0}, {0, 65535, 0}}));
  const Corners signed_unit{{-1, 0, 0}, {1, 0, 0}, {0, 1, -1}};
  EXPECT_EQ(load_quantized<std::int8_t>(kByte, true), signed_unit);
  EXPECT_EQ(load_quantized<std::int16_t>(kShort, true), signed_unit);
  const Corners unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(load_quantized<std::uint8_t>(kUnsignedByte, true), unit);
  EXPECT_EQ(load_quantized<std::uint16_t>(kUnsignedShort, true), unit);
}

/// A square of four vertices in the order of a strip or a fan.
Scene load_mode(int mode, const std::vector<float>& positions) {
  GltfBuilder file;
  const int accessor = file.add_accessor(positions, kFloat, "VEC3");
  file.add_root({{"mesh", file.add_mesh({{"POSITION", accessor}}, -1, -1, mode)}});
  return load(file).scene;
}

TEST(LoadGeometry, StripsAndFansWindOneWay) {
  const Scene strip = load_mode(5, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  ASSERT_EQ(strip.triangles.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(winding_normal(strip, i), Vec3(0, 0, 1)) << i;
  const Scene fan = load_mode(6, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  ASSERT_EQ(fan.triangles.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(winding_normal(fan, i), Vec3(0, 0, 1)) << i;
}

TEST(LoadGeometry, PointsAndLinesAreSkippedWithAWarning) {
  GltfBuilder file = one_triangle();
  file.add_root({{"mesh", file.add_mesh({{"POSITION", 0}}, -1, -1, 0)}});
  file.add_root({{"mesh", file.add_mesh({{"POSITION", 0}}, -1, -1, 3)}});
  const LoadedScene loaded = load(file);
  EXPECT_EQ(loaded.scene.triangles.size(), 1U);
  ASSERT_FALSE(loaded.warnings.empty());
  EXPECT_EQ(loaded.warnings[0], "points and lines are left out (2 times)");
}

TEST(LoadGeometry, OnlyTheDefaultSceneIsShown) {
  GltfBuilder file = one_triangle();
  file.root["nodes"].push_back({{"mesh", 0}, {"translation", {5, 0, 0}}});
  file.root["scenes"].push_back({{"nodes", {1}}});
  file.root["scene"] = 1;
  EXPECT_EQ(corners(load(file).scene)[0], Vec3(5, 0, 0));
}

TEST(LoadGeometry, WithoutScenesTheRootNodesAreShown) {
  GltfBuilder file = one_triangle();
  file.root["nodes"] = json::array(
      {{{"mesh", 0}, {"translation", {1, 0, 0}}}, {{"children", {0}}, {"translation", {1, 0, 0}}}});
  file.root.erase("scenes");
  file.root.erase("scene");
  const Scene scene = load(file).scene;
  ASSERT_EQ(scene.triangles.size(), 1U);
  EXPECT_EQ(corners(scene)[0], Vec3(2, 0, 0));
}

TEST(LoadGeometry, SameFileGivesTheSameBytes) {
  const Scene a = load(one_triangle()).scene;
  const Scene b = load(one_triangle()).scene;
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.triangles, b.triangles);
}

}  // namespace
}  // namespace sheaf::test
