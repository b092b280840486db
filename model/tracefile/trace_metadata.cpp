// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/trace_metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace sheaf {
namespace {

using nlohmann::json;

struct BadMetadata : std::runtime_error {
  using std::runtime_error::runtime_error;
};

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

json to_json(const MemoryTraceStream& stream) {
  json caches = json::array();
  for (const MemoryTraceCache& cache : stream.caches) {
    caches.push_back({{"name", cache.name}, {"group", cache.group}});
  }
  return {{"name", stream.name},
          {"group", stream.group},
          {"contexts", stream.contexts},
          {"turnaround", stream.turnaround},
          {"retry_interval", stream.retry_interval},
          {"awaited", stream.awaited},
          {"caches", caches}};
}

json to_json(const MemoryOperation& operation) {
  return {{"cache", operation.cache},    {"kind", to_string(operation.kind)},
          {"bytes", operation.bytes},    {"write", operation.write},
          {"calls", operation.calls},    {"port_cycles", operation.port_cycles},
          {"latency", operation.latency}};
}

json to_json(const MemoryLayout& layout) {
  json streams = json::array();
  for (const MemoryTraceStream& stream : layout.streams) streams.push_back(to_json(stream));
  json operations = json::array();
  for (const MemoryOperation& operation : layout.operations) {
    operations.push_back(to_json(operation));
  }
  return {
      {"streams", streams}, {"operations", operations}, {"answer_latency", layout.answer_latency}};
}

// What a replay could not cope with is refused here.
template <typename T>
T number_from(const json& object, const char* key, std::uint64_t least, std::uint64_t most) {
  const json& value = object.at(key);
  // What the parser takes for unsigned is a whole number from 0 to 2^64 - 1.
  if (!value.is_number_unsigned()) {
    throw BadMetadata(fmt::format("{} is no whole number from {} to {}", key, least, most));
  }
  const auto number = value.get<std::uint64_t>();
  if (number < least || number > most) {
    throw BadMetadata(fmt::format("{} is {}, not {} to {}", key, number, least, most));
  }
  return static_cast<T>(number);
}

// 64 units of three kinds (parameters.cpp) and the film, each with one or two caches.
constexpr std::uint64_t kMaxStreams = 256;
constexpr std::uint64_t kMaxCaches = 4;
constexpr std::uint64_t kMaxLatency = 1'000'000'000;
constexpr std::uint64_t kMaxEdge = 16384;                    // of a picture: parameters.cpp
constexpr std::uint64_t kMaxCount = std::uint64_t{1} << 53;  // of cycles or rays

DataKind kind_from(const std::string& name) {
  for (std::size_t i = 0; i < kNumDataKinds; ++i) {
    if (to_string(static_cast<DataKind>(i)) == name) return static_cast<DataKind>(i);
  }
  throw BadMetadata("a kind of data is not known");
}

// Names become paths in a report.
std::string name_from(const json& value, const char* key) {
  auto name = value.at(key).get<std::string>();
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (name.empty() || name.size() > 64 || !std::ranges::all_of(name, is_plain)) {
    throw BadMetadata(fmt::format("a {} is not made of a-z, 0-9 and _", key));
  }
  return name;
}

MemoryTraceStream stream_from(const json& value) {
  MemoryTraceStream stream;
  stream.name = name_from(value, "name");
  stream.group = name_from(value, "group");
  stream.contexts = number_from<std::uint32_t>(value, "contexts", 1, 64);
  stream.turnaround = number_from<Cycles>(value, "turnaround", 0, kMaxLatency);
  stream.retry_interval = number_from<Cycles>(value, "retry_interval", 1, kMaxLatency);
  stream.awaited = value.at("awaited").get<bool>();
  if (value.at("caches").size() > kMaxCaches) throw BadMetadata("a unit has too many caches");
  for (const json& cache : value.at("caches")) {
    stream.caches.push_back({name_from(cache, "name"), name_from(cache, "group")});
  }
  return stream;
}

MemoryOperation operation_from(const json& value) {
  MemoryOperation operation;
  operation.cache = number_from<std::uint8_t>(value, "cache", 0, 255);
  operation.kind = kind_from(value.at("kind").get<std::string>());
  operation.bytes = number_from<std::uint32_t>(value, "bytes", 0, kMaxFrameBytes);
  operation.write = value.at("write").get<bool>();
  operation.calls = value.at("calls").get<bool>();
  operation.port_cycles = number_from<std::uint32_t>(value, "port_cycles", 1, kMaxLatency);
  operation.latency = number_from<std::uint32_t>(value, "latency", 0, kMaxLatency);
  return operation;
}

// Any unit of a group can do what another one did.
void check_group(const MemoryLayout& layout, const MemoryTraceStream& stream) {
  for (const MemoryTraceStream& other : layout.streams) {
    if (other.group != stream.group) continue;
    const auto group = [](const MemoryTraceCache& cache) { return cache.group; };
    if (other.awaited == stream.awaited &&
        std::ranges::equal(other.caches, stream.caches, {}, group, group)) {
      continue;
    }
    throw BadMetadata("two units of a group are not alike");
  }
}

MemoryLayout layout_from(const json& value) {
  MemoryLayout layout;
  const std::size_t num_streams = value.at("streams").size();
  if (num_streams == 0 || num_streams > kMaxStreams) {
    throw BadMetadata(fmt::format("there are {} streams, not 1 to {}", num_streams, kMaxStreams));
  }
  for (const json& stream : value.at("streams")) layout.streams.push_back(stream_from(stream));
  std::set<std::string> names;
  for (const MemoryTraceStream& stream : layout.streams) {
    for (const MemoryTraceCache& cache : stream.caches) {
      if (!names.insert(stream.name + "." + cache.name).second) {
        throw BadMetadata("two caches have the same name");
      }
    }
  }
  for (const MemoryTraceStream& stream : layout.streams) check_group(layout, stream);
  for (const json& operation : value.at("operations")) {
    layout.operations.push_back(operation_from(operation));
  }
  layout.answer_latency = number_from<Cycles>(value, "answer_latency", 1, kMaxLatency);
  return layout;
}

float real_from(const json& value) {
  const auto number = value.get<double>();
  if (!(std::abs(number) <= std::numeric_limits<float>::max())) {
    throw BadMetadata("a number of the camera is too large");
  }
  return static_cast<float>(number);
}

Vec3 vec_from(const json& value) {
  return {real_from(value.at(0)), real_from(value.at(1)), real_from(value.at(2))};
}

Camera camera_from(const json& value) {
  Camera c;
  c.position = vec_from(value.at("position"));
  c.right = vec_from(value.at("right"));
  c.up = vec_from(value.at("up"));
  c.forward = vec_from(value.at("forward"));
  c.orthographic = value.at("orthographic").get<bool>();
  c.half_height = real_from(value.at("half_height"));
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
    all["memory"] = to_json(metadata.memory);
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
    metadata.cycles = number_from<std::uint64_t>(all, "cycles", 0, kMaxCount);
    metadata.num_rays = number_from<std::uint64_t>(all, "rays", 0, kMaxCount);
    metadata.width = number_from<std::uint32_t>(all.at("image"), "width", 0, kMaxEdge);
    metadata.height = number_from<std::uint32_t>(all.at("image"), "height", 0, kMaxEdge);
    if (reader.identity().kind == TraceKind::kRays) {
      metadata.camera = camera_from(all.at("camera"));
    } else {
      metadata.memory = layout_from(all.at("memory"));
    }
    return metadata;
  } catch (const BadMetadata& error) {
    reader.refuse(0, std::string("its metadata cannot be understood: ") + error.what());
  } catch (const json::exception& error) {
    reader.refuse(0, std::string("its metadata cannot be understood: ") + error.what());
  }
}

}  // namespace sheaf
