// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>

#include "gltf_builder.h"
#include "scene/gltf_json.h"
#include "scene/gltf_limits.h"
#include "scene/gltf_refusal.h"

namespace sheaf::test {
namespace {

/// Peak memory of this process in MiB.
long peak_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

TEST(RefuseLimits, MoreJsonThanIsRead) {
  try {
    (void)gltf::parse_gltf_json(std::string(gltf::kMaxJsonBytes + 1, ' '));
    ADD_FAILURE() << "read";
  } catch (const gltf::Refusal& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("268435457 bytes of JSON"), std::string::npos)
        << refusal.what();
  }
}

TEST(RefuseLimits, CountsThatNoBufferBacks) {
  GltfBuilder file = one_triangle();
  file.root["accessors"][0].erase("bufferView");
  file.root["accessors"][0]["count"] = gltf::kMaxZeroElements + 1;
  expect_refused(file, {"/accessors/0", "without a bufferView"});
  file.root["accessors"][0]["count"] = ~std::uint64_t{0};
  expect_refused(file, {"/accessors/0", "without a bufferView"});
  file = one_triangle();
  file.root["accessors"][0]["count"] = ~std::uint64_t{0};
  expect_refused(file, {"/accessors/0", "past"});
}

TEST(RefuseLimits, InstancesTimesTriangles) {
  // 10^4 triangles in 10^4 instances from a file of 300 KB, refused before any is made.
  constexpr std::uint64_t kMany = 10'000;
  GltfBuilder file;
  const int positions = file.add_accessor(std::vector<float>(9 * kMany, 0.5F), kFloat, "VEC3");
  const int places = file.add_accessor(std::vector<std::int8_t>(4 * kMany, 1), kByte, "VEC4", true);
  file.add_root(
      {{"mesh", file.add_mesh({{"POSITION", positions}})},
       {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"ROTATION", places}}}}}}}});
  const long before = peak_mib();
  expect_refused(file, {"/meshes/0/primitives/0", "10000 triangles in 10000 instances"});
  EXPECT_LT(peak_mib() - before, 100);
}

TEST(RefuseLimits, InstanceCountsDoNotOverflow) {
  GltfBuilder file = one_triangle();
  const int places = file.add_accessor_on(-1, kFloat, "VEC3", gltf::kMaxZeroElements);
  for (int i = 0; i < 5; ++i) {
    file.add_root(
        {{"mesh", 0},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"SCALE", places}}}}}}}});
  }
  expect_refused(file, {"/nodes/4", "instances exceed"});
}

TEST(RefuseLimits, MoreEntriesThanAnySceneHas) {
  GltfBuilder file = one_triangle();
  file.root["textures"] = json(gltf::kMaxEntries + 1, json::object());
  expect_refused(file, {"/textures", "1048577 entries"});
}

/// A grey progressive JPEG whose scans hold nothing, ten bytes each.
std::vector<std::uint8_t> jpeg(std::uint16_t side, int scans) {
  const auto high = static_cast<std::uint8_t>(side >> 8U);
  const auto low = static_cast<std::uint8_t>(side);
  std::vector<std::uint8_t> bytes{0xFF, 0xD8, 0xFF, 0xC2, 0, 11,   8, high,
                                  low,  high, low,  1,    1, 0x11, 0};
  for (const auto table : std::array<std::uint8_t, 2>{0x00, 0x10}) {  // of a single code each
    bytes.insert(bytes.end(), {0xFF, 0xC4, 0, 20, table, 1});
    bytes.resize(bytes.size() + 16);
  }
  for (int i = 0; i < scans; ++i) {
    bytes.insert(bytes.end(), {0xFF, 0xDA, 0, 8, 1, 1, 0, 1, 63, 0});
  }
  bytes.insert(bytes.end(), {0xFF, 0xD9});
  return bytes;
}

GltfBuilder with_images(const std::vector<std::vector<std::uint8_t>>& images) {
  GltfBuilder file = one_triangle();
  for (const std::vector<std::uint8_t>& image : images) {
    const auto number = file.root["images"].size();
    file.root["images"].push_back({{"bufferView", file.add_view(image)}});
    file.root["textures"].push_back({{"source", number}});
    const json texture{{"index", number}};
    file.root["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}});
    json primitive = file.root["meshes"][0]["primitives"][0];
    primitive["material"] = number;
    file.root["meshes"][0]["primitives"].push_back(primitive);
  }
  return file;
}

TEST(RefuseLimits, TexelsOfAllImages) {
  // Of what is in these headers nothing is unpacked: the first has all texels that there may be.
  const auto header = [](std::uint16_t side) { return jpeg(side, 0); };
  expect_refused(with_images({header(16385)}), {"/images/0", "limits of 16384 a side"});
  expect_refused(with_images({jpeg(16, 1), header(16384)}), {"/images/1", "268435456 in all"});
}

TEST(RefuseLimits, ScansTimesTexelsOfAllImages) {
  expect_refused(with_images({jpeg(16384, 17)}), {"/images/0", "17 scans of 268435456 pixels"});
  constexpr int kScans = 1 << 16;  // of 2^16 pixels
  EXPECT_EQ(load(with_images({jpeg(256, kScans / 64)})).scene.textures.size(), 1U);
  expect_refused(with_images({jpeg(16, 1), jpeg(256, kScans)}), {"/images/1", "65536 scans"});
}

TEST(RefuseLimits, DeepJson) {
  const TempFolder folder;
  const auto path = folder.path() / "scene.gltf";
  constexpr std::size_t kDepth = 1'000'000;
  write_text(path, R"({"asset":{"version":"2.0"},"x":)" + std::string(kDepth, '[') +
                       std::string(kDepth, ']') + "}");
  const long before = peak_mib();
  expect_refused(path, {"nested deeper"});
  EXPECT_LT(peak_mib() - before, 30);  // the file twice, not what it would be parsed into
}

TEST(RefuseLimits, JsonAsDeepAsIsAllowed) {
  const TempFolder folder;
  const auto path = folder.path() / "scene.gltf";
  const auto write = [&](int levels) {  // of arrays, in one of the root
    GltfBuilder file = one_triangle();
    file.root["extras"] = "[[ no level \\\" [[ \\\\";
    const std::string text = file.gltf(data_uri(file.binary, "application/octet-stream"));
    write_text(path, R"({"more":)" + std::string(levels, '[') + std::string(levels, ']') + "," +
                         text.substr(1));
  };
  write(gltf::kMaxJsonDepth - 1);
  EXPECT_NO_THROW(static_cast<void>(load_scene(path)));
  write(gltf::kMaxJsonDepth);
  expect_refused(path, {"nested deeper than 64 levels"});
}

TEST(RefuseLimits, DeepNodesAreWalkedWithoutRecursion) {
  GltfBuilder file = one_triangle();
  constexpr int kDepth = 100'000;
  file.root["nodes"] = json::array();
  for (int i = 0; i < kDepth; ++i) file.root["nodes"].push_back({{"children", {i + 1}}});
  file.root["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(load(file).scene.triangles.size(), 1U);
}

TEST(RefuseLimits, SmallPartsOfALargeSharedAccessorCostOnlyThemselves) {
  // 3000 primitives that each use one triangle of the same 300,000 vertices.
  constexpr std::uint32_t kVertices = 300'000;
  GltfBuilder file;
  const int positions = file.add_accessor(std::vector<float>(3 * kVertices, 1.0F), kFloat, "VEC3");
  json primitives = json::array();
  const int view = file.add_view(std::vector<std::uint32_t>{0, 1, kVertices - 1});
  for (int i = 0; i < 3000; ++i) {
    const int indices = file.add_accessor_on(view, kUnsignedInt, "SCALAR", 3);
    primitives.push_back(
        {{"attributes", {{"POSITION", positions}, {"NORMAL", positions}}}, {"indices", indices}});
  }
  file.root["meshes"].push_back({{"primitives", primitives}});
  file.add_root({{"mesh", 0}});
  const Scene scene = load(file).scene;
  EXPECT_EQ(scene.triangles.size(), 3000U);
  EXPECT_EQ(scene.positions.size(), 9000U);
}

}  // namespace
}  // namespace sheaf::test
