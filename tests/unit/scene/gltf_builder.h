// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/load_gltf.h"

namespace sheaf::test {

using nlohmann::json;

inline constexpr int kByte = 5120;
inline constexpr int kUnsignedByte = 5121;
inline constexpr int kShort = 5122;
inline constexpr int kUnsignedShort = 5123;
inline constexpr int kUnsignedInt = 5125;
inline constexpr int kFloat = 5126;

/// A folder of its own for each test, gone with it.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A glTF file in the making: JSON that a test may change at will, and one buffer.
class GltfBuilder {
 public:
  GltfBuilder();

  template <typename T>
  int add_view(const std::vector<T>& values, int stride = 0) {
    return add_view_bytes(values.data(), values.size() * sizeof(T), stride);
  }
  /// Accessor over all of `values`, `type` as in the file ("VEC3").
  template <typename T>
  int add_accessor(const std::vector<T>& values, int component_type, const char* type,
                   bool normalized = false) {
    const int view = add_view(values);
    return add_accessor_on(view, component_type, type, values.size() / components(type),
                           normalized);
  }
  int add_accessor_on(int view, int component_type, const char* type, std::uint64_t count,
                      bool normalized = false);

  /// One mesh of one primitive with the given attributes; returns the mesh.
  int add_mesh(const json& attributes, int indices = -1, int material = -1, int mode = 4);
  /// A node of the scene with further members; returns it.
  int add_root(json node);

  [[nodiscard]] std::vector<std::uint8_t> glb() const;
  /// As .gltf with the buffer under `uri`; nothing else is written.
  [[nodiscard]] std::string gltf(const std::string& uri) const;

  json root;
  std::vector<std::uint8_t> binary;

 private:
  static std::uint64_t components(const char* type);
  int add_view_bytes(const void* data, std::size_t size, int stride);
};

/// One counter-clockwise triangle (0,0,0) (1,0,0) (0,1,0) in mesh 0, placed by node 0.
[[nodiscard]] GltfBuilder one_triangle();
/// Corner coordinates of that triangle.
[[nodiscard]] std::vector<float> triangle_positions();

void write_bytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes);
void write_text(const std::filesystem::path& path, std::string_view text);

/// Writes the file as GLB into a folder of its own and loads it.
[[nodiscard]] LoadedScene load(const GltfBuilder& file, const SceneLoadOptions& options = {});
/// The scene's triangles as corner positions, three a triangle.
[[nodiscard]] std::vector<Vec3> corners(const Scene& scene);
/// Normal of a triangle from its winding.
[[nodiscard]] Vec3 winding_normal(const Scene& scene, std::size_t triangle);

/// Checks that the file is refused with exit code 3 in one line that begins with its name and has
/// all the words.
void expect_refused(const std::filesystem::path& path,
                    std::initializer_list<std::string_view> words);
void expect_refused(const GltfBuilder& file, std::initializer_list<std::string_view> words);

/// A PNG of the given size, all texels of one colour.
[[nodiscard]] std::vector<std::uint8_t> png(int width, int height, std::uint8_t red);
[[nodiscard]] std::string data_uri(const std::vector<std::uint8_t>& bytes, const char* type);

}  // namespace sheaf::test
