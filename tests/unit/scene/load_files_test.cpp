// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "gltf_builder.h"

namespace sheaf::test {
namespace {

const std::vector<Vec3> kTriangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(LoadFiles, ExternalBufferBesideTheScene) {
  const TempFolder folder;
  const GltfBuilder file = one_triangle();
  write_bytes(folder.path() / "data.bin", file.binary);
  write_text(folder.path() / "scene.gltf", file.gltf("data.bin"));
  EXPECT_EQ(corners(load_scene(folder.path() / "scene.gltf").scene), kTriangle);
}

TEST(LoadFiles, ExternalBufferInASubfolderWithEscapesAndPlus) {
  const TempFolder folder;
  const GltfBuilder file = one_triangle();
  std::filesystem::create_directory(folder.path() / "a b");
  write_bytes(folder.path() / "a b" / "d+1.bin", file.binary);
  write_text(folder.path() / "scene.gltf", file.gltf("a%20b/d+1.bin"));
  EXPECT_EQ(corners(load_scene(folder.path() / "scene.gltf").scene), kTriangle);
}

TEST(LoadFiles, ExternalBufferMayBeLongerThanItsByteLength) {
  const TempFolder folder;
  const GltfBuilder file = one_triangle();
  std::vector<std::uint8_t> longer = file.binary;
  longer.resize(longer.size() + 3);
  write_bytes(folder.path() / "data.bin", longer);
  write_text(folder.path() / "scene.gltf", file.gltf("data.bin"));
  EXPECT_EQ(corners(load_scene(folder.path() / "scene.gltf").scene), kTriangle);
}

TEST(LoadFiles, BufferAsDataUriOfAnyMediaType) {
  const TempFolder folder;
  const GltfBuilder file = one_triangle();
  for (const char* type : {"application/octet-stream", "application/gltf-buffer", "x/y", ""}) {
    write_text(folder.path() / "scene.gltf", file.gltf(data_uri(file.binary, type)));
    EXPECT_EQ(corners(load_scene(folder.path() / "scene.gltf").scene), kTriangle) << type;
  }
}

TEST(LoadFiles, ContentDecidesNotTheName) {
  const TempFolder folder;
  const GltfBuilder file = one_triangle();
  write_bytes(folder.path() / "scene.gltf", file.glb());
  EXPECT_EQ(corners(load_scene(folder.path() / "scene.gltf").scene), kTriangle);
}

TEST(LoadFiles, UnknownGlbChunksAreSkipped) {
  const TempFolder folder;
  std::vector<std::uint8_t> bytes = one_triangle().glb();
  const std::vector<std::uint8_t> chunk{4, 0, 0, 0, 'X', 'Y', 'Z', 'W', 1, 2, 3, 4};
  bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  bytes[8] = static_cast<std::uint8_t>(bytes[8] + 12);
  bytes[9] = static_cast<std::uint8_t>(bytes[9] + (bytes[8] < 12 ? 1 : 0));
  write_bytes(folder.path() / "scene.glb", bytes);
  EXPECT_EQ(corners(load_scene(folder.path() / "scene.glb").scene), kTriangle);
}

TEST(LoadFiles, ExtrasAndUnknownOptionalExtensionsAreIgnored) {
  GltfBuilder file = one_triangle();
  file.root["extras"] = {{"children", {-1, 0.5}}, {"deep", {{{"a", {1, {2}}}}}}};
  file.root["extensionsUsed"] = {"VENDOR_thing"};
  file.root["extensions"] = {{"VENDOR_thing", {{"mesh", -7}}}};
  const LoadedScene loaded = load(file);
  EXPECT_EQ(corners(loaded.scene), kTriangle);
  EXPECT_EQ(loaded.counts.extensions, std::vector<std::string>{"VENDOR_thing"});
}

}  // namespace
}  // namespace sheaf::test
