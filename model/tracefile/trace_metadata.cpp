// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/trace_metadata.h"

#include <nlohmann/json.hpp>

namespace sheaf {
namespace {

using nlohmann::json;

json to_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

json to_json(const Camera& c) {
  return {{"position", to_json(c.position)},
          {"right", to_json(c.right)},
          {"up", to_json(c.up)},
          {"forward", to_json(c.forward)},
          {"orthographic", c.orthographic},
          {"half_height", c.half_height}};
}

Vec3 vec_from(const json& value) {
  return {value.at(0).get<float>(), value.at(1).get<float>(), value.at(2).get<float>()};
}

Camera camera_from(const json& value) {
  Camera c;
  c.position = vec_from(value.at("position"));
  c.right = vec_from(value.at("right"));
  c.up = vec_from(value.at("up"));
  c.forward = vec_from(value.at("forward"));
  c.orthographic = value.at("orthographic").get<bool>();
  c.half_height = value.at("half_height").get<float>();
  return c;
}

}  // namespace

std::string metadata_json(const TraceMetadata& metadata, TraceKind kind) {
  json all{{"sheaf", metadata.version},
           {"kind", to_string(kind)},
           {"scene", {{"name", metadata.scene_name}, {"path", metadata.scene_path}}},
           {"config", metadata.config},
           {"complete", metadata.complete},
           {"cycles", metadata.cycles},
           {"rays", metadata.num_rays},
           {"image", {{"width", metadata.width}, {"height", metadata.height}}}};
  if (kind == TraceKind::kRays) {
    all["camera"] = to_json(metadata.camera);
  } else {
    json requesters = json::array();
    for (const TraceMetadata::Requester& r : metadata.requesters) {
      requesters.push_back({{"name", r.name}, {"cache", r.cache}});
    }
    all["requesters"] = requesters;
  }
  return all.dump(1, ' ', false, json::error_handler_t::replace);
}

TraceMetadata read_metadata(const TraceReader& reader) {
  try {
    const json all = json::parse(reader.metadata());
    TraceMetadata metadata;
    metadata.version = all.at("sheaf").get<std::string>();
    metadata.scene_name = all.at("scene").at("name").get<std::string>();
    metadata.scene_path = all.at("scene").at("path").get<std::string>();
    metadata.config = all.at("config").get<std::string>();
    metadata.complete = all.at("complete").get<bool>();
    metadata.cycles = all.at("cycles").get<std::uint64_t>();
    metadata.num_rays = all.at("rays").get<std::uint64_t>();
    metadata.width = all.at("image").at("width").get<std::uint32_t>();
    metadata.height = all.at("image").at("height").get<std::uint32_t>();
    if (reader.identity().kind == TraceKind::kRays) {
      metadata.camera = camera_from(all.at("camera"));
    } else {
      for (const json& r : all.at("requesters")) {
        metadata.requesters.push_back(
            {r.at("name").get<std::string>(), r.at("cache").get<std::string>()});
      }
    }
    return metadata;
  } catch (const json::exception& error) {
    reader.refuse(0, std::string("its metadata cannot be understood: ") + error.what());
  }
}

}  // namespace sheaf
