// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf_builder.h"
#include "scene/gltf_texture.h"

namespace sheaf::test {
namespace {

/// A triangle with texture coordinates and a material whose base colour has texture 0, a PNG of
/// 2 x 3 texels in a buffer view.
GltfBuilder textured() {
  GltfBuilder file;
  const int positions = file.add_accessor(triangle_positions(), kFloat, "VEC3");
  const int uvs = file.add_accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, kFloat, "VEC2");
  file.root["materials"] = json::array(
      {{{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorTexture", {{"index", 0}}}}}}});
  file.root["textures"] = json::array({{{"source", 0}}});
  const int view = file.add_view(png(2, 3, 200));
  file.root["images"] = json::array({{{"bufferView", view}, {"mimeType", "image/png"}}});
  file.add_root({{"mesh", file.add_mesh({{"POSITION", positions}, {"TEXCOORD_0", uvs}}, -1, 0)}});
  return file;
}

json& base_texture(GltfBuilder& file) {
  return file.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
}

TEST(LoadTexture, EmbeddedPngIsDecoded) {
  const Scene scene = load(textured()).scene;
  ASSERT_EQ(scene.textures.size(), 1U);
  const Texture& t = scene.textures[0];
  EXPECT_EQ(t.width, 2U);
  EXPECT_EQ(t.height, 3U);
  ASSERT_EQ(t.rgba.size(), 24U);
  EXPECT_EQ(t.rgba[0], 200);
  EXPECT_EQ(t.rgba[3], 255);
  EXPECT_EQ(scene.materials[0].base_color_texture, 0);
  EXPECT_EQ(scene.uvs, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_TRUE(scene.needs.textures);
}

TEST(LoadTexture, ImageAsDataUriOrFile) {
  const TempFolder folder;
  GltfBuilder file = textured();
  file.root["images"][0] = {{"uri", data_uri(png(4, 1, 9), "image/png")}};
  write_bytes(folder.path() / "scene.glb", file.glb());
  EXPECT_EQ(load_scene(folder.path() / "scene.glb").scene.textures.at(0).width, 4U);
  file.root["images"][0] = {{"uri", "t.png"}};
  write_bytes(folder.path() / "scene.glb", file.glb());
  write_bytes(folder.path() / "t.png", png(5, 1, 9));
  EXPECT_EQ(load_scene(folder.path() / "scene.glb").scene.textures.at(0).width, 5U);
}

TEST(LoadTexture, SamplerGivesWrapAndFilter) {
  GltfBuilder file = textured();
  file.root["samplers"] = json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}});
  file.root["textures"][0]["sampler"] = 0;
  const Texture t = load(file).scene.textures.at(0);
  EXPECT_EQ(t.wrap_u, Texture::Wrap::kClampToEdge);
  EXPECT_EQ(t.wrap_v, Texture::Wrap::kMirroredRepeat);
  EXPECT_TRUE(t.nearest);
  const Texture plain = load(textured()).scene.textures.at(0);
  EXPECT_EQ(plain.wrap_u, Texture::Wrap::kRepeat);
  EXPECT_FALSE(plain.nearest);
}

TEST(LoadTexture, OneImageIsDecodedOnceForEachSampler) {
  GltfBuilder file = textured();
  file.root["textures"].push_back({{"source", 0}});
  file.root["materials"].push_back(
      {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}});
  file.add_root(
      {{"mesh", file.add_mesh(file.root["meshes"][0]["primitives"][0]["attributes"], -1, 1)}});
  EXPECT_EQ(load(file).scene.textures.size(), 1U);
  file.root["samplers"] = json::array({{{"wrapS", 33071}}});
  file.root["textures"][1]["sampler"] = 0;
  EXPECT_EQ(load(file).scene.textures.size(), 2U);
}

TEST(LoadTexture, UnusedTexturesAreNeitherReadNorKept) {
  GltfBuilder file = textured();
  // An unused image that cannot be decoded, and a texture of a lamp that does not glow.
  file.root["images"].push_back({{"uri", "missing.png"}});
  file.root["textures"].push_back({{"source", 1}});
  file.root["materials"][0]["emissiveTexture"] = {{"index", 1}};
  EXPECT_EQ(load(file).scene.textures.size(), 1U);
}

TEST(LoadTexture, UntexturedSceneHasNoCoordinates) {
  GltfBuilder file = textured();
  file.root["materials"][0]["pbrMetallicRoughness"].erase("baseColorTexture");
  const Scene scene = load(file).scene;
  EXPECT_TRUE(scene.uvs.empty());
  EXPECT_TRUE(scene.textures.empty());
  EXPECT_FALSE(scene.needs.textures);
}

TEST(LoadTexture, EmissiveTextureOfALamp) {
  GltfBuilder file = textured();
  file.root["materials"][0] = {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}};
  const Scene scene = load(file).scene;
  EXPECT_EQ(scene.materials[0].emission_texture, 0);
  EXPECT_EQ(scene.materials[0].base_color_texture, kNoTexture);
  EXPECT_EQ(scene.uvs.size(), 3U);
}

TEST(LoadTexture, EmissiveTextureWithOtherCoordinatesIsLeftOut) {
  GltfBuilder file = textured();
  file.root["materials"][0]["emissiveFactor"] = {1, 1, 1};
  file.root["materials"][0]["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
  const LoadedScene loaded = load(file, {.light_position = Vec3(1)});
  EXPECT_EQ(loaded.scene.materials[0].emission_texture, kNoTexture);
  EXPECT_EQ(loaded.scene.materials[0].emission, Vec3(0));
  EXPECT_EQ(loaded.warnings.size(), 1U);
}

TEST(LoadTexture, SecondSetOfCoordinates) {
  GltfBuilder file = textured();
  const int uvs = file.add_accessor(std::vector<std::uint16_t>{0, 65535, 65535, 0, 0, 0},
                                    kUnsignedShort, "VEC2", true);
  file.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = uvs;
  base_texture(file)["texCoord"] = 1;
  EXPECT_EQ(load(file).scene.uvs, (std::vector<Vec2>{{0, 1}, {1, 0}, {0, 0}}));
}

TEST(LoadTexture, TransformIsBakedIntoTheCoordinates) {
  GltfBuilder file = textured();
  file.root["extensionsRequired"] = {"KHR_texture_transform"};
  base_texture(file)["extensions"]["KHR_texture_transform"] = {
      {"offset", {10, 20}}, {"scale", {2, 3}}, {"rotation", std::numbers::pi / 2}};
  const std::vector<Vec2> uvs = load(file).scene.uvs;
  // Scaled, then turned counter-clockwise in an image whose v axis points down: u goes to -v.
  EXPECT_LT(glm::distance(uvs[0], Vec2(10, 20)), 1e-5F);
  EXPECT_LT(glm::distance(uvs[1], Vec2(10, 18)), 1e-5F);
  EXPECT_LT(glm::distance(uvs[2], Vec2(13, 20)), 1e-5F);
}

TEST(LoadTexture, PrimitivesWithoutCoordinatesGetZeros) {
  GltfBuilder file = textured();
  file.root["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  const Scene scene = load(file).scene;
  EXPECT_EQ(scene.uvs, std::vector<Vec2>(3, Vec2(0)));
}

TEST(LoadTexture, BrokenOrMissingImagesInUseAreRefused) {
  GltfBuilder file = textured();
  file.root["images"][0] = {{"uri", "missing.png"}};
  expect_refused(file, {"/images/0", "missing.png", "no such file"});
  file.root["images"][0] = {{"uri", data_uri({'G', 'I', 'F', '8', '9', 'a'}, "image/gif")}};
  expect_refused(file, {"/images/0", "neither PNG nor JPEG"});
  std::vector<std::uint8_t> cut = png(64, 64, 1);
  cut.resize(cut.size() / 2);
  file.root["images"][0] = {{"uri", data_uri(cut, "image/png")}};
  expect_refused(file, {"/images/0", "broken image"});
  file = textured();
  base_texture(file)["index"] = 5;
  expect_refused(file, {"/materials/0/pbrMetallicRoughness/baseColorTexture", "no texture 5"});
  file = textured();
  file.root["textures"][0]["source"] = 3;
  expect_refused(file, {"/textures/0", "no image 3"});
}

TEST(LoadTexture, HugeImageIsRefusedBeforeItIsDecoded) {
  // Only the header has the size (bytes 16 to 23 of a PNG, big-endian).
  const auto claim = [](int width, int height) {
    std::vector<std::uint8_t> bytes = png(2, 2, 1);
    bytes[18] = static_cast<std::uint8_t>(width >> 8);
    bytes[19] = static_cast<std::uint8_t>(width & 255);
    bytes[22] = static_cast<std::uint8_t>(height >> 8);
    bytes[23] = static_cast<std::uint8_t>(height & 255);
    return data_uri(bytes, "image/png");
  };
  GltfBuilder file = textured();
  file.root["images"][0] = {{"uri", claim(2, 16385)}};
  expect_refused(file, {"/images/0", "2 x 16385 pixels exceed"});
  file.root["images"][0] = {{"uri", claim(65535, 65535)}};
  expect_refused(file, {"/images/0", "larger than 16384 x 16384"});
}

TEST(LoadTexture, AllImagesTogetherHaveALimit) {
  GltfBuilder file = textured();
  file.root["images"].push_back({{"uri", data_uri(png(5, 1, 9), "image/png")}});
  file.root["textures"].push_back({{"source", 1}});
  const TempFolder folder;
  write_bytes(folder.path() / "scene.glb", file.glb());
  gltf::Document document = gltf::open_document(folder.path() / "scene.glb");
  std::vector<Texture> textures;
  gltf::TextureReader enough(document, textures, 2 * 3 + 5);
  EXPECT_EQ(enough.use("", 0), 0);
  EXPECT_EQ(enough.use("", 1), 1);
  gltf::TextureReader short_of_one(document, textures, 2 * 3 + 4);
  EXPECT_EQ(short_of_one.use("", 0), 2);
  EXPECT_THROW((void)short_of_one.use("", 1), gltf::Refusal);
}

}  // namespace
}  // namespace sheaf::test
