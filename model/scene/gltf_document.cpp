// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "scene/gltf_json.h"
#include "scene/gltf_limits.h"

namespace sheaf::gltf {
namespace {

using nlohmann::json;

/// A top-level array taken out of the document.
json take_array(json& root, const char* key) {
  const auto found = root.find(key);
  if (found == root.end()) return json::array();
  json taken = std::move(*found);
  root.erase(found);
  if (!taken.is_array()) refuse(fmt::format("/{}", key), "is not an array");
  return taken;
}

std::optional<std::string> take_uri(json& object, const std::string& place) {
  if (!object.is_object()) refuse(place, "is not an object");
  const auto found = object.find("uri");
  if (found == object.end()) return std::nullopt;
  if (!found->is_string()) refuse(place + "/uri", "is not a string");
  return std::move(found->get_ref<std::string&>());
}

std::uint64_t byte_length(const json& buffer, const std::string& place) {
  const auto found = buffer.find("byteLength");
  if (found == buffer.end() || !found->is_number_unsigned()) {
    refuse(place + "/byteLength", "is missing or not a whole number");
  }
  return found->get<std::uint64_t>();
}

ByteView checked_prefix(ByteView bytes, std::uint64_t length, const std::string& place) {
  if (length > bytes.size()) {
    refuse(place, fmt::format("byteLength {} is more than the {} bytes that are there", length,
                              bytes.size()));
  }
  return bytes.first(length);
}

void read_buffers(Document& document, json buffers, const std::optional<ByteView>& binary) {
  document.owned.reserve(buffers.size());
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const std::string place = fmt::format("/buffers/{}", i);
    const std::optional<std::string> uri = take_uri(buffers[i], place);
    const std::uint64_t length = byte_length(buffers[i], place);
    ByteView bytes;
    if (uri) {
      document.owned.push_back(document.uris.read(place + "/uri", *uri));
      bytes = document.owned.back();
    } else if (i == 0 && binary) {
      bytes = *binary;
    } else {
      refuse(place, "has neither a uri nor a GLB's binary chunk");
    }
    document.buffers.push_back(checked_prefix(bytes, length, place));
  }
}

void list_images(Document& document, json images) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::string place = fmt::format("/images/{}", i);
    ImageSource image;
    if (std::optional<std::string> uri = take_uri(images[i], place)) {
      document.uris.check(place + "/uri", *uri);
      image.uri = std::move(*uri);
    } else if (const auto view = images[i].find("bufferView");
               view != images[i].end() && view->is_number()) {
      image.buffer_view = view->get<int>();
    } else {
      refuse(place, "has neither a uri nor a bufferView");
    }
    document.images.push_back(std::move(image));
  }
}

/// tinygltf's messages name a property but no place: the entry it stopped at is the first that is
/// missing from the model, in the order in which it parses.
std::string place_of_failure(const tinygltf::Model& model,
                             const std::vector<std::pair<const char*, std::size_t>>& listed) {
  const std::array<std::size_t, 9> parsed{
      model.bufferViews.size(), model.accessors.size(), model.meshes.size(),
      model.nodes.size(),       model.scenes.size(),    model.materials.size(),
      model.textures.size(),    model.samplers.size(),  model.cameras.size()};
  for (std::size_t i = 0; i < listed.size(); ++i) {
    if (parsed[i] < listed[i].second) return fmt::format("/{}/{}", listed[i].first, parsed[i]);
  }
  return "";
}

void parse_model(tinygltf::Model& model, json root) {
  std::vector<std::pair<const char*, std::size_t>> listed;
  for (const char* key : {"bufferViews", "accessors", "meshes", "nodes", "scenes", "materials",
                          "textures", "samplers", "cameras"}) {
    const auto found = root.find(key);
    if (found != root.end() && !found->is_array()) {
      refuse(fmt::format("/{}", key), "is not an array");
    }
    listed.emplace_back(key, found == root.end() ? 0 : found->size());
  }
  const std::string text = root.dump();
  root = json();
  std::string error;
  std::string warning;
  tinygltf::TinyGLTF parser;
  bool parsed = false;
  try {
    parsed = parser.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                        static_cast<unsigned>(text.size()), "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    error = e.what();
  }
  std::ranges::replace(error, '\n', ' ');  // each of its lines ends with a line break
  error.erase(error.find_last_not_of(' ') + 1);
  if (!parsed || !error.empty()) refuse(place_of_failure(model, listed), error);
}

}  // namespace

Document open_document(const std::filesystem::path& path) {
  Bytes8 bytes = read_file(path, kMaxBytes);
  Document document(path);
  document.file_bytes = std::move(bytes);
  const Container container = split_container(document.file_bytes);
  json root = parse_gltf_json(container.json);
  read_buffers(document, take_array(root, "buffers"), container.binary);
  list_images(document, take_array(root, "images"));
  if (!take_array(root, "animations").empty()) {
    document.warnings.add("animations are left out; the scene is shown as it stands in the file");
  }
  (void)take_array(root, "skins");
  parse_model(document.model, std::move(root));
  return document;
}

ByteView buffer_view_bytes(const Document& document, const std::string& place, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= document.model.bufferViews.size()) {
    refuse(place, fmt::format("there is no bufferView {}", index));
  }
  const tinygltf::BufferView& view = document.model.bufferViews[static_cast<std::size_t>(index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= document.buffers.size()) {
    refuse(fmt::format("/bufferViews/{}", index),
           fmt::format("there is no buffer {}", view.buffer));
  }
  const ByteView buffer = document.buffers[static_cast<std::size_t>(view.buffer)];
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
    refuse(fmt::format("/bufferViews/{}", index),
           fmt::format("{} bytes at offset {} run past buffer {} of {} bytes", view.byteLength,
                       view.byteOffset, view.buffer, buffer.size()));
  }
  return buffer.subspan(view.byteOffset, view.byteLength);
}

}  // namespace sheaf::gltf
