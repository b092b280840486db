// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/gltf_texture.h"
#include "scene/scene.h"

namespace sheaf::gltf {

/// Roughness up to which a metal is taken for a perfect mirror. The exported mirrors of common
/// tools have 0 to 0.1; beyond, a single reflection ray would be far from the surface's lobe.
inline constexpr double kMirrorRoughness = 0.1;

/// Where the texture coordinates of a material come from (KHR_texture_transform included).
struct UvSource {
  int set = 0;                ///< TEXCOORD_<set>
  glm::mat3 transform{1.0F};  ///< applied to (u, v, 1)
  bool operator==(const UvSource&) const = default;
};

/// Translates the materials that triangles use; the mapping is described at load_scene.
class MaterialReader {
 public:
  MaterialReader(Document& document, std::optional<float> reflectance, Scene& scene)
      : document_(document),
        reflectance_(reflectance),
        scene_(scene),
        textures_(document, scene.textures) {}

  /// Index into the scene's materials of glTF material `index` (-1: the default material), which
  /// `place` refers to.
  std::uint16_t use(const std::string& place, int index);

  /// The texture coordinates that a scene material needs; none if it has no texture.
  [[nodiscard]] const std::optional<UvSource>& uv_source(std::uint16_t material) const {
    return uv_sources_[material];
  }

 private:
  void read_material(const tinygltf::Material& source, const std::string& place, Material& result);
  std::optional<UvSource> read_textures(const tinygltf::Material& source, const std::string& place,
                                        Material& result);
  void warn_of_losses(const tinygltf::Material& source);

  Document& document_;
  std::optional<float> reflectance_;
  Scene& scene_;
  TextureReader textures_;
  std::map<int, std::uint16_t> known_;
  std::vector<std::optional<UvSource>> uv_sources_;
};

}  // namespace sheaf::gltf
