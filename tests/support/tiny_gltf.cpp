// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "support/tiny_gltf.h"

#include "support/scratch_folder.h"

namespace sheaf::test {

TinyGltf::TinyGltf()
    : positions{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 2, -1, 1, 2, 1, 1, 2, 1, -1, 2},
      indices{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7} {
  json = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [
      {"attributes": {"POSITION": 0}, "indices": 1, "material": 0},
      {"attributes": {"POSITION": 0}, "indices": 2, "material": 1}]}],
    "materials": [
      {"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.8, 0.7, 1],
                                "metallicFactor": 0.5, "roughnessFactor": 0}},
      {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.6, 0.7, 1],
                                "metallicFactor": 1, "roughnessFactor": 0},
       "emissiveFactor": [0.1, 0.2, 0.3]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
       "min": [-1, -1, 0], "max": [1, 1, 2]},
      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
      {"bufferView": 1, "byteOffset": 12, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 96},
                    {"buffer": 0, "byteOffset": 96, "byteLength": 24}]
  })");
}

std::filesystem::path TinyGltf::write(const std::filesystem::path& folder,
                                      const std::string& name) const {
  const auto bytes = [](const auto& values) {
    return std::string(reinterpret_cast<const char*>(values.data()),
                       values.size() * sizeof values[0]);
  };
  const std::string buffer = bytes(positions) + bytes(indices);
  nlohmann::json whole = json;
  whole["buffers"] = {{{"uri", name + ".bin"}, {"byteLength", buffer.size()}}};
  write_bytes(folder / (name + ".bin"), buffer);
  write_bytes(folder / (name + ".gltf"), whole.dump());
  return folder / (name + ".gltf");
}

}  // namespace sheaf::test
