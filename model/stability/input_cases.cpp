// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Small scene files that ask for what they must not get.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "scene/load_gltf.h"
#include "stability/catalogue.h"

namespace sheaf::stability {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A folder of its own, with a secret beside the one that scenes lie in.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "sheaf-stability-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw Error(ExitCode::kOutput, "cannot make a temporary folder; is TMPDIR writable?");
    }
    root_ = name;
    fs::create_directory(root_ / "scenes");
    std::ofstream(root_ / "secret.bin") << triangle_bytes();
    fs::create_symlink(root_ / "secret.bin", root_ / "scenes" / "link.bin");
    std::ofstream(root_ / "scenes" / "data.bin") << triangle_bytes();
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// What scenes must not read: buffers as they need them.
  [[nodiscard]] std::string secret() const { return (root_ / "secret.bin").string(); }

  /// Whether the loader takes a scene.
  [[nodiscard]] bool takes(const Json& scene) const {
    const fs::path file = root_ / "scenes" / "scene.gltf";
    std::ofstream(file) << scene.dump();
    try {
      static_cast<void>(load_scene(file));
      return true;
    } catch (const Error& error) {
      return error.code() != ExitCode::kScene;
    }
  }

 private:
  /// Three corners, then three indices.
  static std::string triangle_bytes() {
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::uint32_t indices[3] = {0, 1, 2};
    std::string bytes(reinterpret_cast<const char*>(corners), sizeof corners);
    return bytes.append(reinterpret_cast<const char*>(indices), sizeof indices);
  }
  fs::path root_;
};

/// PNG files of 70 bytes: of one texel, and with a header that claims 65535 × 65535.
const char* const kSmallImage =
    "data:image/"
    "png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAAC0lEQVR42mNgAAIAAAUAAen63NgAAAAASUVORK5CYII=";
const char* const kHugeImage =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAA//8AAP//"
    "CAYAAAC2BdlQAAAAC0lEQVR42mNgAAIAAAUAAen63NgAAAAASUVORK5CYII=";

/// One triangle with one texel on it, as it should be.
Json sound() {
  Json scene = Json::parse(R"({
    "asset": {"version": "2.0"},
    "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 0}],
    "buffers": [{"uri": "data.bin", "byteLength": 48}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                    {"buffer": 0, "byteOffset": 36, "byteLength": 12}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"}]})");
  scene["images"] = Json::array({{{"uri", kSmallImage}}});
  return scene;
}

struct Spoilt {
  const char* what;
  std::function<void(Json&)> spoil;
};

std::vector<Spoilt> beyond_the_file() {
  return {
      {"more vertices than the view holds", [](Json& j) { j["accessors"][0]["count"] = 4; }},
      {"more indices than the view holds", [](Json& j) { j["accessors"][1]["count"] = 6; }},
      {"an accessor that begins behind its view",
       [](Json& j) { j["accessors"][1]["byteOffset"] = 4096; }},
      {"an offset near 2^63", [](Json& j) { j["accessors"][0]["byteOffset"] = 1LL << 62; }},
      {"a view behind the buffer", [](Json& j) { j["bufferViews"][1]["byteOffset"] = 40; }},
      {"a stride past the end", [](Json& j) { j["bufferViews"][0]["byteStride"] = 24; }},
      {"an index past the vertices",
       [](Json& j) { j["bufferViews"][1]["byteOffset"] = 12; }},  // 1.0F as an index
      {"a buffer longer than its file", [](Json& j) { j["buffers"][0]["byteLength"] = 4096; }},
      {"an accessor that is not there",
       [](Json& j) { j["meshes"][0]["primitives"][0]["indices"] = 7; }},
      {"sparse values past the end",
       [](Json& j) {
         j["accessors"][0]["sparse"] = {{"count", 3},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5125}}},
                                        {"values", {{"bufferView", 1}}}};
       }},
  };
}

std::vector<Spoilt> beyond_the_folder(const std::string& secret) {
  const auto uri = [](const std::string& path) {
    return [path](Json& j) { j["buffers"][0]["uri"] = path; };
  };
  return {{"the folder above", uri("../secret.bin")},
          {"the folder above, escaped", uri("%2e%2e/secret.bin")},
          {"up and down", uri("sub/../../secret.bin")},
          {"an absolute path", uri(secret)},
          {"a file URI", uri("file://" + secret)},
          {"a link to a file outside", uri("link.bin")}};
}

std::vector<Spoilt> beyond_memory() {
  return {{"a trillion vertices for nothing",
           [](Json& j) {
             j["accessors"][0].erase("bufferView");
             j["accessors"][0]["count"] = 1LL << 40;
           }},
          {"a buffer of 100 GB", [](Json& j) { j["buffers"][0]["byteLength"] = 100'000'000'000; }},
          {"an image of 17 GB", [](Json& j) { j["images"][0]["uri"] = kHugeImage; }},
          {"a million million triangles by instances",
           [](Json& j) {
             j["nodes"] = Json::array();
             Json children = Json::array();
             // Each level has ten times the one below.
             j["nodes"].push_back({{"mesh", 0}});
             for (int level = 1; level <= 12; ++level) {
               Json node;
               node["children"] = Json(10, level - 1);
               j["nodes"].push_back(node);
             }
             j["scenes"][0]["nodes"] = {12};
           }},
          {"nodes in a circle", [](Json& j) { j["nodes"][0]["children"] = {0}; }}};
}

std::vector<Finding> refuse(const Scratch& scratch, const std::vector<Spoilt>& all,
                            const char* why) {
  Failures taken;
  taken.check(scratch.takes(sound()), [] { return "the sound scene is refused"; });
  for (const Spoilt& spoilt : all) {
    Json scene = sound();
    spoilt.spoil(scene);
    taken.check(!scratch.takes(scene), [&] { return spoilt.what; });
  }
  return {taken.finding("hostile scenes taken, or sound ones refused", why)};
}

}  // namespace

std::vector<StabilityCase> input_cases() {
  return {{"input", "beyond the file", "scenes that read past what they hold",
           [](const Effort&) {
             return refuse(Scratch(), beyond_the_file(),
                           "every access is checked against its view, every view "
                           "against its buffer, every buffer against its file");
           }},
          {"input", "beyond the folder", "scenes that name files outside of their folder",
           [](const Effort&) {
             const Scratch scratch;
             return refuse(scratch, beyond_the_folder(scratch.secret()),
                           "paths are relative and lead nowhere up (gltf_uri.h)");
           }},
          {"input", "beyond memory", "files of a kilobyte that ask for a hundred gigabytes",
           [](const Effort&) {
             return refuse(Scratch(), beyond_memory(),
                           "the limits in gltf_limits.h, checked before anything is "
                           "allocated");
           }}};
}

}  // namespace sheaf::stability
