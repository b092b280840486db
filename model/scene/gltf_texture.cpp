// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_texture.h"

#include <fmt/format.h>
#include <stb_image.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

namespace sheaf::gltf {
namespace {

Texture::Wrap to_wrap(int mode, const std::string& place) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Texture::Wrap::kRepeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Texture::Wrap::kMirroredRepeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Texture::Wrap::kClampToEdge;
    default:
      refuse(place, fmt::format("{} is not a wrapping mode", mode));
  }
}

template <std::size_t kSize>
bool begins_with(ByteView bytes, const std::array<std::uint8_t, kSize>& magic) {
  return bytes.size() > kSize && std::equal(magic.begin(), magic.end(), bytes.begin());
}

/// stb decodes more formats than glTF allows; only these two reach it.
bool is_png(ByteView bytes) {
  return begins_with(bytes, std::array<std::uint8_t, 4>{0x89, 'P', 'N', 'G'});
}
bool is_jpeg(ByteView bytes) {
  return begins_with(bytes, std::array<std::uint8_t, 3>{0xFF, 0xD8, 0xFF});
}

/// Every place that could be the beginning of a scan, so that none can be hidden.
std::uint64_t num_scans(ByteView jpeg) {
  constexpr std::array<std::uint8_t, 2> kStartOfScan{0xFF, 0xDA};
  std::uint64_t count = 0;
  auto at = jpeg.begin();
  while ((at = std::search(at, jpeg.end(), kStartOfScan.begin(), kStartOfScan.end())) !=
         jpeg.end()) {
    ++count;
    ++at;
  }
  return count;
}

void take_scans(std::uint64_t scans, std::uint64_t texels, const std::string& place,
                std::uint64_t& remaining) {
  // At most 2^31 scans of 2^28 texels.
  if (scans * texels > remaining) {
    refuse(place, fmt::format("{} scans of {} pixels exceed the limit of {} scans of {} pixels in "
                              "all images; save it without progression",
                              scans, texels, kMaxScansPerTexel, kMaxTexels));
  }
  remaining -= scans * texels;
}

void decode(ByteView bytes, const std::string& place, ImageAllowance& remaining, Texture& texture) {
  if (!(is_png(bytes) || is_jpeg(bytes)) || bytes.size() > std::numeric_limits<int>::max()) {
    refuse(place, "is neither PNG nor JPEG; convert it");
  }
  const auto length = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  if (!stbi_info_from_memory(bytes.data(), length, &width, &height, &channels) || width < 1 ||
      height < 1) {
    refuse(place, fmt::format("broken image, or larger than {0} x {0} ({1})", kMaxImageSide,
                              stbi_failure_reason()));
  }
  texture.width = static_cast<std::uint32_t>(width);
  texture.height = static_cast<std::uint32_t>(height);
  const std::uint64_t texels = std::uint64_t{texture.width} * texture.height;
  if (std::max(texture.width, texture.height) > kMaxImageSide || texels > remaining.texels) {
    refuse(place, fmt::format("{} x {} pixels exceed the limits of {} a side and {} in all images; "
                              "scale it down",
                              width, height, kMaxImageSide, kMaxTexels));
  }
  remaining.texels -= texels;
  if (is_jpeg(bytes)) take_scans(num_scans(bytes), texels, place, remaining.scanned_texels);
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(bytes.data(), length, &width, &height, &channels, 4), &stbi_image_free);
  if (!pixels) refuse(place, fmt::format("broken image: {}", stbi_failure_reason()));
  texture.rgba.assign(pixels.get(), pixels.get() + std::size_t{texture.width} * texture.height * 4);
}

}  // namespace

std::int32_t TextureReader::use(const std::string& place, int index) {
  const auto& list = document_.model.textures;
  if (static_cast<std::size_t>(index) >= list.size()) {
    refuse(place, fmt::format("there is no texture {}", index));
  }
  const tinygltf::Texture& source = list[static_cast<std::size_t>(index)];
  if (source.source < 0) {
    document_.warnings.add("textures without a PNG or JPEG image are left out");
    return kNoTexture;
  }
  const std::string own = fmt::format("/textures/{}", index);
  if (static_cast<std::size_t>(source.source) >= document_.images.size()) {
    refuse(own, fmt::format("there is no image {}", source.source));
  }
  Texture texture = read_sampler(own, source.sampler);
  const Key key{source.source, texture.wrap_u, texture.wrap_v, texture.nearest};
  const auto [entry, is_new] = known_.try_emplace(key, static_cast<std::int32_t>(textures_.size()));
  if (is_new) {
    read_image(source.source, texture);
    textures_.push_back(std::move(texture));
  }
  return entry->second;
}

Texture TextureReader::read_sampler(const std::string& place, int sampler) const {
  Texture texture;
  if (sampler < 0) return texture;
  const auto& list = document_.model.samplers;
  if (static_cast<std::size_t>(sampler) >= list.size()) {
    refuse(place, fmt::format("there is no sampler {}", sampler));
  }
  const tinygltf::Sampler& source = list[static_cast<std::size_t>(sampler)];
  const std::string own = fmt::format("/samplers/{}", sampler);
  texture.wrap_u = to_wrap(source.wrapS, own + "/wrapS");
  texture.wrap_v = to_wrap(source.wrapT, own + "/wrapT");
  texture.nearest = source.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  return texture;
}

void TextureReader::read_image(int source, Texture& texture) {
  const ImageSource& image = document_.images[static_cast<std::size_t>(source)];
  const std::string place = fmt::format("/images/{}", source);
  if (image.uri.empty()) {
    decode(buffer_view_bytes(document_, place, image.buffer_view), place, remaining_, texture);
  } else {
    const Bytes8 bytes = document_.uris.read(place + "/uri", image.uri);
    decode(bytes, place, remaining_, texture);
  }
}

}  // namespace sheaf::gltf
