// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/gltf_limits.h"
#include "scene/scene.h"

namespace sheaf::gltf {

/// What the images that are still to come may ask for.
struct ImageAllowance {
  std::uint64_t texels;
  std::uint64_t scanned_texels;  ///< of all scans
};

/// Decodes the images of the textures that materials ask for, once for each image and sampler.
class TextureReader {
 public:
  /// All images together may have `max_texels`.
  TextureReader(Document& document, std::vector<Texture>& textures,
                std::uint64_t max_texels = kMaxTexels)
      : document_(document),
        textures_(textures),
        remaining_{max_texels, kMaxScansPerTexel * max_texels} {}

  /// Index into the scene's textures of glTF texture `index`, or kNoTexture, with a warning, for a
  /// texture that has no image of the core format.
  [[nodiscard]] std::int32_t use(const std::string& place, int index);

 private:
  using Key = std::tuple<int, Texture::Wrap, Texture::Wrap, bool>;

  [[nodiscard]] Texture read_sampler(const std::string& place, int sampler) const;
  void read_image(int source, Texture& texture);

  Document& document_;
  std::vector<Texture>& textures_;
  std::map<Key, std::int32_t> known_;
  ImageAllowance remaining_;
};

}  // namespace sheaf::gltf
