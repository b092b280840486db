// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Small scene files that ask for what they must not get.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "scene/load_gltf.h"
#include "stability/catalogue.h"
#include "stability/child_process.h"

namespace sheaf::stability {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Far more than any scene here needs, far less than those ask for that are to be refused.
constexpr ChildLimits kLimits{
    .cpu_seconds = 60, .wall_seconds = 600, .address_bytes = std::uint64_t{1} << 31U};
const char* const kTaken = "taken";

/// A grey progressive JPEG of 16384 × 16384 pixels and 17 scans, in which there is nothing.
std::string jpeg_of_many_scans() {
  const auto bytes = [](std::initializer_list<int> values) {
    return std::string(values.begin(), values.end());
  };
  std::string file = bytes({0xFF, 0xD8, 0xFF, 0xC2, 0, 11, 8, 64, 0, 64, 0, 1, 1, 0x11, 0});
  for (const int table : {0x00, 0x10}) {  // of a single code each
    file += bytes({0xFF, 0xC4, 0, 20, table, 1}) + std::string(16, '\0');
  }
  for (int i = 0; i < 17; ++i) file += bytes({0xFF, 0xDA, 0, 8, 1, 1, 0, 1, 63, 0});
  return file + bytes({0xFF, 0xD9});
}

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
    std::ofstream(root_ / "scenes" / "scans.jpg") << jpeg_of_many_scans();
    std::ofstream(root_ / "scenes" / "huge.bin").flush();
    fs::resize_file(root_ / "scenes" / "huge.bin", (std::uint64_t{1} << 32U) + 1);
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// What scenes must not read: buffers as they need them.
  [[nodiscard]] std::string secret() const { return (root_ / "secret.bin").string(); }

  /// What the loader says to a scene, in a process of its own, which may fall.
  [[nodiscard]] std::string answer(const Json& scene) const {
    const fs::path file = root_ / "scenes" / "scene.gltf";
    std::ofstream(file) << scene.dump();
    const auto load = [&]() -> std::string {
      try {
        static_cast<void>(load_scene(file));
        return kTaken;
      } catch (const Error& error) {
        return error.code() == ExitCode::kScene ? error.what() : "no fault of the scene";
      }
    };
    return run_in_child(load, kLimits);
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

/// PNG files of 70 bytes: of one texel, and with headers that claim 65535 × 65535, a line of 16385
/// and, with 16384 × 16384, all texels that a scene may have.
const char* const kSmallImage =
    "data:image/"
    "png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAAC0lEQVR42mNgAAIAAAUAAen63NgAAAAASUVORK5CYII=";
const char* const kHugeImage =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAA//8AAP//"
    "CAYAAAC2BdlQAAAAC0lEQVR42mNgAAIAAAUAAen63NgAAAAASUVORK5CYII=";

const char* const kLongImage =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAQAEAAAAB"
    "CAYAAAC2BdlQAAAAC0lEQVR42mNgAAIAAAUAAen63NgAAAAASUVORK5CYII=";
const char* const kFullImage =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAQAAAAEAA"
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
  const char* words;  ///< of the message that refuses it
  std::function<void(Json&)> spoil;
};

std::vector<Spoilt> beyond_the_file() {
  const char* const past = "runs past bufferView";
  const char* const not_there = "more than the 48 bytes that are there";
  return {
      {"more vertices than the view holds", past, [](Json& j) { j["accessors"][0]["count"] = 4; }},
      {"more indices than the view holds", past, [](Json& j) { j["accessors"][1]["count"] = 6; }},
      {"an accessor that begins behind its view", past,
       [](Json& j) { j["accessors"][1]["byteOffset"] = 4096; }},
      {"an offset near 2^63", past, [](Json& j) { j["accessors"][0]["byteOffset"] = 1LL << 62; }},
      {"a view behind the buffer", "run past buffer 0",
       [](Json& j) { j["bufferViews"][1]["byteOffset"] = 40; }},
      {"a stride past the end", past, [](Json& j) { j["bufferViews"][0]["byteStride"] = 24; }},
      {"an index past the vertices", "is out of range",
       [](Json& j) { j["bufferViews"][1]["byteOffset"] = 12; }},  // 1.0F as an index
      {"a buffer longer than its file", not_there,
       [](Json& j) { j["buffers"][0]["byteLength"] = 4096; }},
      {"a buffer of 100 GB", not_there,
       [](Json& j) { j["buffers"][0]["byteLength"] = 100'000'000'000; }},
      {"an accessor that is not there", "accessor out of bounds",
       [](Json& j) { j["meshes"][0]["primitives"][0]["indices"] = 7; }},
      {"sparse values past the end", "sparse/values: runs past bufferView",
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
  const char* const out = "leads out of the scene's folder; put";
  return {{"the folder above", out, uri("../secret.bin")},
          {"the folder above, escaped", out, uri("%2e%2e/secret.bin")},
          {"up and down", out, uri("sub/../../secret.bin")},
          {"an absolute path", out, uri(secret)},
          {"a file URI", "is not a file", uri("file://" + secret)},
          {"a link to a file outside", "through a link", uri("link.bin")}};
}

/// Gives the only node so many nodes like it beside it, each of which places its mesh at as many
/// points as a file gets for nothing, 2^24.
void instance(Json& scene, int num_nodes) {
  scene["accessors"].push_back({{"componentType", 5126}, {"count", 1 << 24}, {"type", "VEC3"}});
  const Json attributes{{"TRANSLATION", scene["accessors"].size() - 1}};
  scene["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}};
  for (int i = 1; i < num_nodes; ++i) {
    scene["nodes"].push_back(scene["nodes"][0]);
    scene["scenes"][0]["nodes"].push_back(i);
  }
}

/// Each level of nodes has ten times the one below.
void nest_nodes(Json& scene) {
  scene["nodes"] = {{{"mesh", 0}}};
  for (int level = 1; level <= 12; ++level) {
    scene["nodes"].push_back({{"children", Json(10, level - 1)}});
  }
  scene["scenes"][0]["nodes"] = {12};
}

Json nested_arrays(int levels) {
  Json result = Json::array();
  for (int i = 1; i < levels; ++i) result = Json::array({result});
  return result;
}

std::vector<Spoilt> beyond_memory() {
  return {
      {"a trillion vertices for nothing", "elements without a bufferView are more than",
       [](Json& j) {
         j["accessors"][0].erase("bufferView");
         j["accessors"][0]["count"] = 1LL << 40;
       }},
      {"a file of 4 GiB and a byte", "4294967297 bytes are more than",
       [](Json& j) { j["buffers"][0]["uri"] = "huge.bin"; }},
      {"an image of 17 GB", "larger than 16384 x 16384",
       [](Json& j) { j["images"][0]["uri"] = kHugeImage; }},
      {"an image of too long lines", "limits of 16384 a side",
       [](Json& j) { j["images"][0]["uri"] = kLongImage; }},
      {"a texel more than fits into all images", "268435456 in all images",
       [](Json& j) {
         j["images"].push_back({{"uri", kFullImage}});
         j["textures"].push_back({{"source", 1}});
         j["materials"].push_back(j["materials"][0]);
         j["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
         Json& primitives = j["meshes"][0]["primitives"];
         primitives.push_back(primitives[0]);
         primitives[1]["material"] = 1;
       }},
      {"scans of an image without end", "17 scans of 268435456 pixels exceed",
       [](Json& j) { j["images"][0]["uri"] = "scans.jpg"; }},
      {"84 million triangles by instances of five", "in 16777216 instances exceed",
       [](Json& j) {
         instance(j, 1);
         Json& primitives = j["meshes"][0]["primitives"];
         primitives = Json(5, primitives[0]);
       }},
      {"84 million instances", "the instances exceed the scene's limit",
       [](Json& j) { instance(j, 5); }},
      {"a million million triangles by nodes", "is reached twice", nest_nodes},
      {"nodes in a circle", "is reached twice", [](Json& j) { j["nodes"][0]["children"] = {0}; }},
      {"a million entries and one", "1048577 entries are more than",
       [](Json& j) { j["samplers"] = Json((1 << 20) + 1, Json::object()); }},
      {"arrays without end", "JSON nested deeper than 64 levels",
       [](Json& j) { j["more"] = nested_arrays(64); }}};
}

std::vector<Finding> refuse(const Scratch& scratch, const std::vector<Spoilt>& all,
                            const char* why) {
  Failures wrong;
  const std::string to_sound = scratch.answer(sound());
  wrong.check(to_sound == kTaken, [&] { return "the sound scene: " + to_sound; });
  for (const Spoilt& spoilt : all) {
    Json scene = sound();
    spoilt.spoil(scene);
    const std::string answer = scratch.answer(scene);
    wrong.check(answer.find(spoilt.words) != std::string::npos,
                [&] { return fmt::format("{}: {}", spoilt.what, answer); });
  }
  return {
      wrong.finding("hostile scenes not refused for what they are, or sound ones refused", why)};
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
