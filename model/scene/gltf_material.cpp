// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "scene/gltf_value.h"

namespace sheaf::gltf {
namespace {

double unit_range(double value) {
  return std::clamp(value, 0.0, 1.0);
}

/// Number `key` of the material's extension `name`, or the fallback.
double extension_number(const tinygltf::Material& source, const char* name, const char* key,
                        double fallback, const std::string& place) {
  const tinygltf::Value* extension = find_extension(source.extensions, name);
  if (extension == nullptr) return fallback;
  return number_or(*extension, key, fallback, fmt::format("{}/extensions/{}", place, name));
}

Vec3 read_emission(const tinygltf::Material& source, const std::string& place) {
  const double strength =
      extension_number(source, "KHR_materials_emissive_strength", "emissiveStrength", 1.0, place);
  const std::string own = place + "/emissiveFactor";
  const Vec3 factor = vec3_or(source.emissiveFactor, Vec3(0.0F), own);
  Vec3 result;
  for (int i = 0; i < 3; ++i) {
    result[i] = std::max(0.0F, checked_float(double{factor[i]} * strength, own));
  }
  return result;
}

float read_ior(const tinygltf::Material& source, const std::string& place) {
  const double ior = extension_number(source, "KHR_materials_ior", "ior", 1.5, place);
  // 0 is the extension's way of saying "no Fresnel term", for materials converted from another
  // model.
  if (ior == 0.0) return 1.5F;
  if (!(ior >= 1.0)) {
    refuse(place + "/extensions/KHR_materials_ior/ior", fmt::format("{} is less than 1", ior));
  }
  return checked_float(ior, place + "/extensions/KHR_materials_ior/ior");
}

/// The three weights, which sum to 1; see load_scene.
void split_light(const tinygltf::Material& source, double transmission, Material& result) {
  const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
  const double metallic = unit_range(pbr.metallicFactor);
  const double mirror = pbr.roughnessFactor <= kMirrorRoughness ? metallic : 0.0;
  const double transmitted = transmission * (1.0 - metallic);
  result.mirror_weight = static_cast<float>(mirror);
  result.transmission = static_cast<float>(transmitted);
  result.diffuse_weight = static_cast<float>(1.0 - mirror - transmitted);
}

void make_unlit(Material& m) {
  m.unlit = true;
  m.emission = Vec3(0.0F);
  m.diffuse_weight = 0.0F;
  m.mirror_weight = 0.0F;
  m.transmission = 0.0F;
}

/// scene.reflectance; see SceneLoadOptions. Applied after the textures are known.
void make_reflective(float r, Material& m) {
  if (m.unlit) {
    m.unlit = false;
    m.emission = m.base_color;
    m.emission_texture = m.base_color_texture;
    m.emission *= 1.0F - r;
  } else {
    m.diffuse_weight = (1.0F - r) * (1.0F - m.transmission);
    m.transmission *= 1.0F - r;
  }
  m.mirror_weight = r;
  m.mirror_tinted = false;
}

/// KHR_texture_transform as translation · rotation · scale. The rotation is counter-clockwise as
/// seen in the image, whose v axis points down; the extension's GLSL listing has it the other way
/// round than its text, its sample model and the common viewers (KhronosGroup/glTF issue 1563).
UvSource read_uv_source(const tinygltf::TextureInfo& info, const std::string& place) {
  UvSource source;
  source.set = info.texCoord;
  const tinygltf::Value* extension = find_extension(info.extensions, "KHR_texture_transform");
  if (extension == nullptr) return source;
  const std::string own = place + "/extensions/KHR_texture_transform";
  const Vec2 offset = vec2_or(*extension, "offset", Vec2(0.0F), own);
  const Vec2 scale = vec2_or(*extension, "scale", Vec2(1.0F), own);
  const double angle = number_or(*extension, "rotation", 0.0, own);
  const auto c = static_cast<float>(std::cos(angle));
  const auto s = static_cast<float>(std::sin(angle));
  source.transform = glm::mat3(Vec3(c * scale.x, -s * scale.x, 0.0F),
                               Vec3(s * scale.y, c * scale.y, 0.0F), Vec3(offset, 1.0F));
  if (const int set = index_or_none(*extension, "texCoord", own); set >= 0) source.set = set;
  return source;
}

bool shows_base_color(const Material& m) {
  return m.unlit || m.diffuse_weight > 0.0F || m.transmission > 0.0F ||
         (m.mirror_weight > 0.0F && m.mirror_tinted);
}

}  // namespace

std::uint16_t MaterialReader::use(const std::string& place, int index) {
  const auto& list = document_.model.materials;
  if (index >= 0 && static_cast<std::size_t>(index) >= list.size()) {
    refuse(place, fmt::format("there is no material {}", index));
  }
  if (const auto known = known_.find(index); known != known_.end()) return known->second;
  constexpr std::size_t kMaxMaterials = std::numeric_limits<std::uint16_t>::max();
  if (scene_.materials.size() >= kMaxMaterials) {
    refuse(place, fmt::format("more than {} materials are in use", kMaxMaterials));
  }
  const auto slot = static_cast<std::uint16_t>(scene_.materials.size());
  // The default material of the specification is an untextured rough metal.
  const tinygltf::Material source =
      index < 0 ? tinygltf::Material() : list[static_cast<std::size_t>(index)];
  Material result;
  const std::string own = fmt::format("/materials/{}", index);
  read_material(source, own, result);
  if (index < 0) result.name = "default";
  uv_sources_.push_back(read_textures(source, own, result));
  if (reflectance_) make_reflective(*reflectance_, result);
  scene_.materials.push_back(std::move(result));
  known_.emplace(index, slot);
  return slot;
}

void MaterialReader::read_material(const tinygltf::Material& source, const std::string& place,
                                   Material& result) {
  warn_of_losses(source);
  result.name = printable(source.name, 80);
  for (int i = 0; i < 3; ++i) {
    result.base_color[i] =
        static_cast<float>(unit_range(source.pbrMetallicRoughness.baseColorFactor[i]));
  }
  result.emission = read_emission(source, place);
  result.ior = read_ior(source, place);
  const double transmission = unit_range(
      extension_number(source, "KHR_materials_transmission", "transmissionFactor", 0.0, place));
  split_light(source, transmission, result);
  if (find_extension(source.extensions, "KHR_materials_unlit") != nullptr) make_unlit(result);
}

std::optional<UvSource> MaterialReader::read_textures(const tinygltf::Material& source,
                                                      const std::string& place, Material& result) {
  std::optional<UvSource> uvs;
  const tinygltf::TextureInfo& base = source.pbrMetallicRoughness.baseColorTexture;
  if (base.index >= 0 && shows_base_color(result)) {
    const std::string own = place + "/pbrMetallicRoughness/baseColorTexture";
    result.base_color_texture = textures_.use(own, base.index);
    if (result.base_color_texture != kNoTexture) uvs = read_uv_source(base, own);
  }
  const tinygltf::TextureInfo& glow = source.emissiveTexture;
  if (glow.index >= 0 && result.emission != Vec3(0.0F)) {
    const std::string own = place + "/emissiveTexture";
    const UvSource glow_uvs = read_uv_source(glow, own);
    if (uvs && *uvs != glow_uvs) {
      document_.warnings.add(
          "an emissive texture with other coordinates than the base colour's is "
          "left out, and its emission with it");
      result.emission = Vec3(0.0F);
      return uvs;
    }
    result.emission_texture = textures_.use(own, glow.index);
    if (result.emission_texture != kNoTexture) uvs = glow_uvs;
  }
  return uvs;
}

void MaterialReader::warn_of_losses(const tinygltf::Material& source) {
  if (source.alphaMode != "OPAQUE") {
    document_.warnings.add("alpha masks and blending are shown opaque");
  }
  if (source.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0) {
    document_.warnings.add("metallic-roughness textures are left out; their factors hold");
  }
  if (source.normalTexture.index >= 0) document_.warnings.add("normal maps are left out");
  const tinygltf::Value* transmission =
      find_extension(source.extensions, "KHR_materials_transmission");
  if (transmission != nullptr && transmission->Has("transmissionTexture")) {
    document_.warnings.add("transmission textures are left out; their factors hold");
  }
}

}  // namespace sheaf::gltf
