// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// The whole loader: JSON or GLB, buffers and images in data URIs, flattening, and what the scene
// needs. Every index of the result is used.
#include "fuzz_input.h"
#include "scene/load_gltf.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sheaf::test::read_as_file(data, size, "scene.gltf", [](const std::filesystem::path& path) {
    const sheaf::Scene scene = sheaf::load_scene(path).scene;
    for (const auto& t : scene.triangles) {
      for (const std::uint32_t corner : t) static_cast<void>(scene.positions.at(corner));
    }
    for (const std::uint16_t m : scene.triangle_material) static_cast<void>(scene.materials.at(m));
  });
  return 0;
}
