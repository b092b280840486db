// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_info.h"

#include <gtest/gtest.h>

#include "gltf_builder.h"

namespace sheaf::test {
namespace {

void expect_line(const std::string& text, const std::string& line) {
  EXPECT_NE(("\n" + text).find("\n" + line + "\n"), std::string::npos)
      << "no line \"" << line << "\" in\n"
      << text;
}

TEST(SceneInfo, SaysWhatAFileHoldsAndNeeds) {
  GltfBuilder file = one_triangle();
  file.root["materials"] = json::array(
      {{{"name", "steel"}, {"pbrMetallicRoughness", {{"roughnessFactor", 0}}}}, json::object()});
  file.root["meshes"][0]["primitives"][0]["material"] = 0;
  file.add_root({{"mesh", 0}, {"translation", {3, 0, 0}}});
  file.root["extensionsUsed"] = {"VENDOR_thing"};
  const std::string text = scene_info(load(file, {.light_position = Vec3(0, 2, 0)}));
  expect_line(text, "triangles   2");
  expect_line(text, "vertices    6");
  expect_line(text, "meshes      1, placed 2 times by 2 nodes");
  expect_line(text, "bounds      (0, 0, 0) to (4, 1, 0)");
  expect_line(text, "materials   1 in use, 2 in the file");
  expect_line(text, "            steel: mirror 1 tinted; 2 triangles");
  expect_line(text, "textures    0 in use, 0 images in the file, 0 KiB decoded");
  expect_line(text, "lights      1");
  expect_line(text, "extensions  VENDOR_thing");
  expect_line(text, "            reflection: yes");
  expect_line(text, "            shadow path: no; no light, or nothing diffuse to receive one");
}

TEST(SceneInfo, WorksFromStructsAlone) {
  LoadedScene loaded;
  loaded.scene.materials.emplace_back().unlit = true;
  loaded.scene.lights.emplace_back().type = Light::Type::kSpot;
  loaded.counts.cameras = {"a", "b"};
  loaded.warnings = {"beware"};
  const std::string text = scene_info(loaded);
  expect_line(text, "triangles   0");
  expect_line(text, "            #0: unlit; 0 triangles");
  expect_line(text, "cameras     a, b");
  expect_line(text, "            spot at (0, 0, 0) along (0, 0, -1), (1, 1, 1) cd");
  expect_line(text, "warning     beware");
}

}  // namespace
}  // namespace sheaf::test
