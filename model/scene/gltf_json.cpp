// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "scene/gltf_limits.h"
#include "scene/gltf_refusal.h"

namespace sheaf::gltf {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 8> kKnownExtensions{
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual",        "KHR_materials_emissive_strength",
    "KHR_materials_ior",       "KHR_materials_transmission", "KHR_materials_unlit",
    "KHR_mesh_quantization",   "KHR_texture_transform"};

/// Members whose numbers are indices or enumerations. tinygltf would truncate those beyond 32 bits
/// and ignore those with a fraction.
constexpr std::array<std::string_view, 17> kIndexKeys{
    "buffer",  "bufferView", "camera",   "children", "componentType", "index",
    "indices", "light",      "material", "mesh",     "mode",          "nodes",
    "sampler", "scene",      "skin",     "source",   "texCoord"};

/// Members that count bytes or elements in up to 64 bits, or that tinygltf wants whole.
constexpr std::array<std::string_view, 9> kSizeKeys{"byteLength", "byteOffset", "byteStride",
                                                    "count",      "target",     "wrapS",
                                                    "wrapT",      "magFilter",  "minFilter"};

template <typename List>
bool contains(const List& list, std::string_view key) {
  return std::find(list.begin(), list.end(), key) != list.end();
}

/// Where the walk through the document is; written out only for a message.
struct Place {
  const Place* parent;
  std::string_view key;
  std::size_t index;  ///< in an array, where there is no key

  [[nodiscard]] Place member(std::string_view name) const { return {this, name, 0}; }
  [[nodiscard]] Place element(std::size_t i) const { return {this, {}, i}; }
  [[nodiscard]] std::string pointer() const {
    if (parent == nullptr) return {};
    return fmt::format("{}/{}", parent->pointer(),
                       key.empty() ? std::to_string(index) : std::string(key));
  }
};

bool is_wanted(const Place& object, std::string_view key) {
  if (key == "extras") return false;
  return object.key != "extensions" || contains(kKnownExtensions, key);
}

void check_index(const json& number, const Place& place) {
  if (!number.is_number_unsigned() ||
      number.get<std::uint64_t>() > std::numeric_limits<std::int32_t>::max()) {
    refuse(place.pointer(), fmt::format("{} is not a valid index", number.dump()));
  }
}

/// Whether a number at `place` is an index: by its own key, by its array's, or as an attribute.
bool is_index(const Place& place) {
  const bool is_attribute = place.parent->key == "attributes" && !place.key.empty();
  return is_attribute || contains(kIndexKeys, place.key.empty() ? place.parent->key : place.key);
}

void clean_number(json& number, const Place& place) {
  if (is_index(place)) {
    check_index(number, place);
  } else if (number.is_number_integer() && !contains(kSizeKeys, place.key)) {
    // A quantity that happens to be whole; tinygltf keeps integers of extensions in 32 bits.
    number = number.get<double>();
  }
}

/// Checks a value and all in it, and drops from it what nobody reads. Recursion is no deeper than
/// check_depth allows.
void clean(json& value, const Place& place) {
  if (value.is_object()) {
    for (auto member = value.begin(); member != value.end();) {
      const Place own = place.member(member.key());
      if (is_wanted(place, own.key)) {
        clean(*member++, own);
      } else {
        member = value.erase(member);
      }
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) clean(value[i], place.element(i));
  } else if (value.is_number() && place.parent != nullptr) {
    clean_number(value, place);
  }
}

void check_version(const json& root) {
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object() || !asset->contains("version") ||
      !asset->at("version").is_string()) {
    refuse("/asset/version", "missing: not a glTF 2.0 file");
  }
  const std::string version = asset->at("version").get<std::string>();
  const auto least = asset->find("minVersion");
  if (!version.starts_with("2.") ||
      (least != asset->end() && (!least->is_string() || *least != "2.0"))) {
    refuse("/asset/version",
           fmt::format("\"{}\" is not supported; convert the file to glTF 2.0", version));
  }
}

void check_extension(const std::string& place, const std::string& name) {
  if (contains(kKnownExtensions, name)) return;
  if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression") {
    refuse(place, fmt::format("{} is not supported; decompress the file first, for example with "
                              "gltf-transform copy IN.glb OUT.glb",
                              name));
  }
  if (name == "KHR_texture_basisu" || name == "EXT_texture_webp" || name == "EXT_texture_avif") {
    refuse(place, fmt::format("{} is not supported; convert the textures first, for example with "
                              "gltf-transform png IN.glb OUT.glb",
                              name));
  }
  refuse(place, fmt::format("required extension {} is not supported; export without it", name));
}

void check_required_extensions(const json& root) {
  const auto required = root.find("extensionsRequired");
  if (required == root.end()) return;
  if (!required->is_array()) refuse("/extensionsRequired", "is not an array");
  for (std::size_t i = 0; i < required->size(); ++i) {
    const std::string place = fmt::format("/extensionsRequired/{}", i);
    if (!required->at(i).is_string()) refuse(place, "is not a string");
    check_extension(place, required->at(i).get<std::string>());
  }
}

void check_lengths(const json& root) {
  for (const auto& [key, value] : root.items()) {
    if (value.is_array() && value.size() > kMaxEntries) {
      refuse("/" + key,
             fmt::format("{} entries are more than the {} allowed", value.size(), kMaxEntries));
    }
  }
}

/// nlohmann's messages begin with an identifier in brackets that says nothing to a user.
std::string without_tag(const std::string& message) {
  const std::size_t end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}

/// To be called before it is parsed, which takes some eighty bytes for each bracket that opens.
void check_depth(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxJsonDepth) {
        refuse("", fmt::format("JSON nested deeper than {} levels", kMaxJsonDepth));
      }
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

}  // namespace

json parse_gltf_json(std::string_view text) {
  if (text.size() > kMaxJsonBytes) {
    refuse("", fmt::format("{} bytes of JSON are more than the {} allowed; save as .glb",
                           text.size(), kMaxJsonBytes));
  }
  check_depth(text);
  json root;
  try {
    root = json::parse(text.begin(), text.end());
  } catch (const json::exception& e) {
    refuse("", "broken JSON: " + without_tag(e.what()));
  }
  if (!root.is_object()) refuse("", "not a glTF file: the JSON is not an object");
  clean(root, {nullptr, {}, 0});
  check_version(root);
  check_required_extensions(root);
  check_lengths(root);
  return root;
}

}  // namespace sheaf::gltf
