// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "gltf_builder.h"

namespace sheaf::test {
namespace {

TEST(RefuseContent, UnknownRequiredExtensionIsNamed) {
  GltfBuilder file = one_triangle();
  file.root["extensionsRequired"] = {"KHR_mesh_quantization", "VENDOR_magic"};
  expect_refused(file, {"/extensionsRequired/1", "VENDOR_magic"});
}

TEST(RefuseContent, CompressionHintsAtTheToolThatUndoesIt) {
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
    GltfBuilder file = one_triangle();
    file.root["extensionsRequired"] = {name};
    // Compressed files leave out what the extension holds; the hint must come first.
    file.root["accessors"][0].erase("bufferView");
    file.root["buffers"] = json::array({{{"byteLength", 36}}, {{"byteLength", 36}}});
    expect_refused(file, {name, "gltf-transform"});
  }
}

TEST(RefuseContent, NoTriangles) {
  GltfBuilder empty;
  empty.binary.resize(4);
  expect_refused(empty, {"no triangles"});
  GltfBuilder points = one_triangle();
  points.root["meshes"][0]["primitives"][0]["mode"] = 0;
  expect_refused(points, {"no triangles"});
  GltfBuilder unplaced = one_triangle();
  unplaced.root["scenes"][0]["nodes"] = json::array();
  expect_refused(unplaced, {"no triangles"});
}

TEST(RefuseContent, AccessorPastItsBufferView) {
  GltfBuilder file = one_triangle();
  file.root["accessors"][0]["count"] = 4;
  expect_refused(file, {"/accessors/0", "bufferView 0", "36"});
  file = one_triangle();
  file.root["accessors"][0]["byteOffset"] = 4;
  expect_refused(file, {"/accessors/0", "past"});
  file.root["accessors"][0]["byteOffset"] = std::numeric_limits<std::uint64_t>::max() - 3;
  expect_refused(file, {"/accessors/0", "past"});
}

TEST(RefuseContent, BufferViewPastItsBuffer) {
  GltfBuilder file = one_triangle();
  file.root["bufferViews"][0]["byteLength"] = 40;
  expect_refused(file, {"/bufferViews/0", "36"});
  file.root["bufferViews"][0]["byteLength"] = 36;
  file.root["bufferViews"][0]["byteOffset"] = std::numeric_limits<std::uint64_t>::max() - 35;
  expect_refused(file, {"/bufferViews/0", "past"});
  file = one_triangle();
  file.root["bufferViews"][0]["buffer"] = 7;
  expect_refused(file, {"/bufferViews/0", "no buffer 7"});
}

TEST(RefuseContent, StrideBelowTheElement) {
  GltfBuilder file = one_triangle();
  file.root["bufferViews"][0]["byteStride"] = 8;
  expect_refused(file, {"/accessors/0", "byteStride 8"});
}

TEST(RefuseContent, IndexOutOfRange) {
  GltfBuilder file = one_triangle();
  const int indices =
      file.add_accessor(std::vector<std::uint16_t>{0, 1, 3}, kUnsignedShort, "SCALAR");
  file.root["meshes"][0]["primitives"][0]["indices"] = indices;
  expect_refused(file, {"/accessors/1", "index 3 at 2", "3 vertices"});
}

TEST(RefuseContent, IndicesOfAWrongType) {
  GltfBuilder file = one_triangle();
  const int floats = file.add_accessor(std::vector<float>{0, 1, 2}, kFloat, "SCALAR");
  file.root["meshes"][0]["primitives"][0]["indices"] = floats;
  expect_refused(file, {"/accessors/1", "unsigned integer"});
}

TEST(RefuseContent, AttributesOfAWrongTypeOrCount) {
  GltfBuilder file = one_triangle();
  file.root["accessors"][0]["type"] = "VEC2";
  expect_refused(file, {"/accessors/0", "POSITION"});
  file = one_triangle();
  const int normals = file.add_accessor(std::vector<float>(6), kFloat, "VEC3");
  file.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
  expect_refused(file, {"/accessors/1", "NORMAL", "2", "3"});
}

TEST(RefuseContent, NonFiniteVertices) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    GltfBuilder file;
    std::vector<float> values = triangle_positions();
    const int good = file.add_accessor(values, kFloat, "VEC3");
    values[7] = bad;
    const int broken = file.add_accessor(values, kFloat, "VEC3");
    file.add_root({{"mesh", file.add_mesh({{"POSITION", broken}, {"NORMAL", good}})}});
    expect_refused(file, {"/accessors/1", "element 2", "not finite"});
    file.root["meshes"][0]["primitives"][0]["attributes"] = {{"POSITION", good},
                                                             {"NORMAL", broken}};
    expect_refused(file, {"/accessors/1", "element 2", "not finite"});
  }
}

TEST(RefuseContent, PositionsBeyondSinglePrecision) {
  GltfBuilder file = one_triangle();
  file.root["nodes"][0]["scale"] = {1e300, 1, 1};
  expect_refused(file, {"/accessors/0", "element 1", "not finite"});
}

TEST(RefuseContent, ReferencesThatPointNowhere) {
  const auto refuse_with = [](const char* pointer, const json& value,
                              std::initializer_list<std::string_view> words) {
    GltfBuilder file = one_triangle();
    file.root[json::json_pointer(pointer)] = value;
    expect_refused(file, words);
  };
  refuse_with("/nodes/0/mesh", 4, {"no mesh 4"});
  refuse_with("/nodes/0/children", {9}, {"/nodes/0/children", "no node 9"});
  refuse_with("/scenes/0/nodes", {9}, {"/scenes", "no node 9"});
  refuse_with("/scene", 3, {"/scene", "no scene 3"});
  refuse_with("/nodes/0/camera", 0, {"/nodes/0", "no camera 0"});
  refuse_with("/meshes/0/primitives/0/material", 2, {"/meshes/0/primitives/0/material", "2"});
  refuse_with("/meshes/0/primitives/0/attributes/POSITION", 6, {"POSITION", "no accessor 6"});
  refuse_with("/accessors/0/bufferView", 6, {"/accessors/0", "no bufferView 6"});
  refuse_with("/meshes/0/primitives/0/mode", 9, {"/meshes/0/primitives/0/mode", "9"});
}

TEST(RefuseContent, IndicesThatAreNoWholeNumbers) {
  for (const json& value : {json(-1), json(0.5), json(std::uint64_t{1} << 32)}) {
    GltfBuilder file = one_triangle();
    file.root["nodes"][0]["mesh"] = value;
    expect_refused(file, {"/nodes/0/mesh", "not a valid index"});
    file = one_triangle();
    file.root["scenes"][0]["nodes"][0] = value;
    expect_refused(file, {"/scenes/0/nodes/0", "not a valid index"});
    file = one_triangle();
    file.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = value;
    expect_refused(file, {"/meshes/0/primitives/0/attributes/POSITION", "not a valid index"});
  }
}

TEST(RefuseContent, MissingMembersAreNamedWithTheirPlace) {
  GltfBuilder file = one_triangle();
  file.add_accessor(std::vector<float>{0}, kFloat, "SCALAR");
  file.root["accessors"][1].erase("count");
  expect_refused(file, {"/accessors/1", "count"});
}

TEST(RefuseContent, NodeCycle) {
  GltfBuilder file = one_triangle();
  file.root["nodes"] = json::array({{{"mesh", 0}, {"children", {1}}}, {{"children", {0}}}});
  expect_refused(file, {"/nodes/0", "cycle"});
  file.root["nodes"] = json::array({{{"mesh", 0}, {"children", {0}}}});
  expect_refused(file, {"/nodes/0", "cycle"});
}

TEST(RefuseContent, NodeWithTwoParents) {
  // Thirty levels of two parents each would be a billion instances.
  GltfBuilder file = one_triangle();
  file.root["nodes"] = json::array({{{"children", {1, 1}}}, {{"mesh", 0}}});
  expect_refused(file, {"/nodes/1", "two parents"});
}

TEST(RefuseContent, BrokenTransforms) {
  GltfBuilder file = one_triangle();
  file.root["nodes"][0]["rotation"] = {0, 0, 0, 0};
  expect_refused(file, {"/nodes/0/rotation", "direction"});
  file = one_triangle();
  file.root["nodes"][0]["scale"] = {1, 1};
  expect_refused(file, {"/nodes/0/scale", "2 numbers"});
  file = one_triangle();
  file.root["nodes"][0]["matrix"] = {1, 0, 0};
  expect_refused(file, {"/nodes/0/matrix", "3 numbers"});
}

TEST(RefuseContent, BrokenSparseParts) {
  GltfBuilder file = one_triangle();
  const int indices = file.add_view(std::vector<std::uint16_t>{1, 1});
  const int values = file.add_view(std::vector<float>(6));
  const json good = {{"count", 2},
                     {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
                     {"values", {{"bufferView", values}}}};
  const auto refuse_with = [&](const char* pointer, const json& value, std::string_view word) {
    json sparse = good;
    if (*pointer != '\0') sparse[json::json_pointer(pointer)] = value;
    file.root["accessors"][0]["sparse"] = sparse;
    expect_refused(file, {"/accessors/0/sparse", word});
  };
  refuse_with("", nullptr, "out of order");
  refuse_with("/count", 4, "[1, 3]");
  refuse_with("/count", -1, "[1, 3]");
  refuse_with("/count", 3, "past");
  refuse_with("/indices/componentType", kFloat, "unsigned integer");
  refuse_with("/indices/byteOffset", -4, "negative");
  refuse_with("/indices/byteOffset", 4, "past");
  refuse_with("/values/bufferView", 9, "no bufferView 9");
}

TEST(RefuseContent, LightsAndCamerasOutOfRange) {
  GltfBuilder file = one_triangle();
  file.root["nodes"][0]["extensions"]["KHR_lights_punctual"] = {{"light", 2}};
  expect_refused(file, {"/nodes/0", "no light 2"});
  file.root["nodes"][0]["extensions"]["KHR_lights_punctual"] = {{"light", 0}};
  file.root["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "laser"}}});
  expect_refused(file, {"/lights/0/type", "laser"});
  file = one_triangle();
  file.root["cameras"] =
      json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 4}, {"znear", 1}}}}});
  file.root["nodes"][0]["camera"] = 0;
  expect_refused(file, {"/cameras/0/perspective/yfov", "4"});
}

}  // namespace
}  // namespace sheaf::test
