// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf_builder.h"

#include <gtest/gtest.h>
#include <stb_image_write.h>
#include <unistd.h>

#include <atomic>
#include <fstream>

#include "base/errors.h"

namespace sheaf::test {
namespace {

void append_word(std::vector<std::uint8_t>& bytes, std::uint64_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

void append_chunk(std::vector<std::uint8_t>& bytes, std::uint32_t type, const void* data,
                  std::size_t size, char padding) {
  const std::size_t padded = (size + 3) / 4 * 4;
  append_word(bytes, padded);
  append_word(bytes, type);
  const auto* first = static_cast<const std::uint8_t*>(data);
  bytes.insert(bytes.end(), first, first + size);
  bytes.insert(bytes.end(), padded - size, static_cast<std::uint8_t>(padding));
}

}  // namespace

TempFolder::TempFolder() {
  static std::atomic<int> number{0};
  path_ = std::filesystem::temp_directory_path() /
          ("sheaf_scene_" + std::to_string(getpid()) + "_" + std::to_string(number++));
  std::filesystem::create_directories(path_);
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

GltfBuilder::GltfBuilder() {
  root = {{"asset", {{"version", "2.0"}}},
          {"scene", 0},
          {"scenes", json::array({{{"nodes", json::array()}}})},
          {"nodes", json::array()},
          {"meshes", json::array()},
          {"accessors", json::array()},
          {"bufferViews", json::array()}};
}

std::uint64_t GltfBuilder::components(const char* type) {
  const std::string name(type);
  if (name == "SCALAR") return 1;
  if (name == "VEC2") return 2;
  return name == "VEC3" ? 3 : 4;
}

int GltfBuilder::add_view_bytes(const void* data, std::size_t size, int stride) {
  binary.resize((binary.size() + 3) / 4 * 4);
  json view{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", size}};
  if (stride != 0) view["byteStride"] = stride;
  const auto* first = static_cast<const std::uint8_t*>(data);
  binary.insert(binary.end(), first, first + size);
  root["bufferViews"].push_back(view);
  return static_cast<int>(root["bufferViews"].size()) - 1;
}

int GltfBuilder::add_accessor_on(int view, int component_type, const char* type,
                                 std::uint64_t count, bool normalized) {
  json accessor{{"componentType", component_type}, {"type", type}, {"count", count}};
  if (view >= 0) accessor["bufferView"] = view;
  if (normalized) accessor["normalized"] = true;
  root["accessors"].push_back(accessor);
  return static_cast<int>(root["accessors"].size()) - 1;
}

int GltfBuilder::add_mesh(const json& attributes, int indices, int material, int mode) {
  json primitive{{"attributes", attributes}, {"mode", mode}};
  if (indices >= 0) primitive["indices"] = indices;
  if (material >= 0) primitive["material"] = material;
  root["meshes"].push_back({{"primitives", json::array({primitive})}});
  return static_cast<int>(root["meshes"].size()) - 1;
}

int GltfBuilder::add_root(json node) {
  root["nodes"].push_back(std::move(node));
  const int index = static_cast<int>(root["nodes"].size()) - 1;
  root["scenes"][0]["nodes"].push_back(index);
  return index;
}

std::vector<std::uint8_t> GltfBuilder::glb() const {
  json with_buffer = root;
  if (!with_buffer.contains("buffers")) {
    with_buffer["buffers"] = json::array({{{"byteLength", binary.size()}}});
  }
  const std::string text = with_buffer.dump();
  std::vector<std::uint8_t> chunks;
  append_chunk(chunks, 0x4E4F534A, text.data(), text.size(), ' ');
  append_chunk(chunks, 0x004E4942, binary.data(), binary.size(), '\0');
  std::vector<std::uint8_t> bytes;
  append_word(bytes, 0x46546C67);
  append_word(bytes, 2);
  append_word(bytes, chunks.size() + 12);
  bytes.insert(bytes.end(), chunks.begin(), chunks.end());
  return bytes;
}

std::string GltfBuilder::gltf(const std::string& uri) const {
  json with_buffer = root;
  with_buffer["buffers"] = json::array({{{"byteLength", binary.size()}, {"uri", uri}}});
  return with_buffer.dump();
}

std::vector<float> triangle_positions() {
  return {0, 0, 0, 1, 0, 0, 0, 1, 0};
}

GltfBuilder one_triangle() {
  GltfBuilder file;
  const int positions = file.add_accessor(triangle_positions(), kFloat, "VEC3");
  file.add_root({{"mesh", file.add_mesh({{"POSITION", positions}})}});
  return file;
}

void write_bytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

LoadedScene load(const GltfBuilder& file, const SceneLoadOptions& options) {
  const TempFolder folder;
  write_bytes(folder.path() / "scene.glb", file.glb());
  return load_scene(folder.path() / "scene.glb", options);
}

std::vector<Vec3> corners(const Scene& scene) {
  std::vector<Vec3> result;
  for (const auto& triangle : scene.triangles) {
    for (const std::uint32_t vertex : triangle) result.push_back(scene.positions.at(vertex));
  }
  return result;
}

Vec3 winding_normal(const Scene& scene, std::size_t triangle) {
  const auto& [a, b, c] = scene.triangles.at(triangle);
  const Vec3& origin = scene.positions[a];
  return glm::normalize(glm::cross(scene.positions[b] - origin, scene.positions[c] - origin));
}

void expect_refused(const std::filesystem::path& path,
                    std::initializer_list<std::string_view> words) {
  try {
    (void)load_scene(path);
    ADD_FAILURE() << path << " was loaded";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), ExitCode::kScene) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(message.find(path.string() + ": "), 0U) << message;
    for (const std::string_view word : words) {
      EXPECT_NE(message.find(word), std::string::npos) << message << " lacks " << word;
    }
  }
}

void expect_refused(const GltfBuilder& file, std::initializer_list<std::string_view> words) {
  const TempFolder folder;
  write_bytes(folder.path() / "scene.glb", file.glb());
  expect_refused(folder.path() / "scene.glb", words);
}

std::vector<std::uint8_t> png(int width, int height, std::uint8_t red) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < width * height; ++i) pixels.insert(pixels.end(), {red, 0, 0, 255});
  std::vector<std::uint8_t> bytes;
  const auto append = [](void* context, void* data, int size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    auto* out = static_cast<std::vector<std::uint8_t>*>(context);
    out->insert(out->end(), first, first + size);
  };
  stbi_write_png_to_func(append, &bytes, width, height, 4, pixels.data(), width * 4);
  return bytes;
}

std::string data_uri(const std::vector<std::uint8_t>& bytes, const char* type) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = std::string("data:") + type + ";base64,";
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace sheaf::test
