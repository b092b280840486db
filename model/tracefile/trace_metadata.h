// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "tracefile/memory_layout.h"
#include "tracefile/trace_reader.h"

namespace sheaf {

/// What a trace tells in its metadata frame: a JSON object of the same structure.
struct TraceMetadata {
  std::string version;       ///< of the Sheaf that recorded it
  std::string scene_name;    ///< file name
  std::string scene_path;    ///< as it was given
  std::string config;        ///< the resolved configuration, TOML
  bool complete = true;      ///< the frame was finished
  std::uint64_t cycles = 0;  ///< length of the recorded run; 0 where time was not simulated
  std::uint64_t num_rays = 0;
  std::uint32_t width = 0;   ///< of the picture, in pixels
  std::uint32_t height = 0;  ///< of the picture, in pixels
  Camera camera;             ///< rays: of the primary rays, which are not in the trace
  MemoryLayout memory;       ///< memory: what the records refer to
};

[[nodiscard]] std::string metadata_json(const TraceMetadata& metadata, TraceKind kind);

/// Throws Error(kTrace) if the metadata of an open trace are not as they should be.
[[nodiscard]] TraceMetadata read_metadata(const TraceReader& reader);

}  // namespace sheaf
