// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace sheaf::test {

/// A glTF file of two mirrors that stand across from each other, one of them glowing, without
/// camera and light; to be changed, or spoilt, and written.
struct TinyGltf {
  TinyGltf();

  nlohmann::json json;
  std::vector<float> positions;        ///< of 8 vertices
  std::vector<std::uint16_t> indices;  ///< of 4 triangles

  /// Writes `name`.gltf and `name`.bin into the folder; returns the path of the former.
  std::filesystem::path write(const std::filesystem::path& folder,
                              const std::string& name = "tiny") const;
};

}  // namespace sheaf::test
