// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/recorded_config.h"

#include <fmt/format.h>

#include <utility>

#include "base/errors.h"

namespace sheaf {
namespace {

template <typename Spec>
std::uint64_t lines_of(const Spec& cache) {
  return cache.mode == CacheMode::kNormal ? cache.capacity / cache.line : 0;
}

// At most 2^36 lines a cache, 64 units a kind: nothing wraps.
std::uint64_t num_lines(const Config& c) {
  return c.traversal_unit.count * lines_of(c.node_cache) +
         c.intersection_unit.count * lines_of(c.triangle_cache) +
         c.shader_unit.count * (lines_of(c.attribute_cache) + lines_of(c.texture_cache)) +
         lines_of(c.film_cache) + lines_of(c.l2);
}

// Nobody typed it: what is wrong with it is wrong with the trace.
Config resolve(const BaseConfig& base) {
  try {
    return resolve_config_over(base, std::nullopt, {});
  } catch (const Error& problem) {
    throw Error(ExitCode::kTrace, problem.what());
  }
}

}  // namespace

RecordedConfig recorded_config(const TraceReader& reader, const TraceMetadata& metadata) {
  BaseConfig base{metadata.config, reader.path().string() + ", recorded configuration"};
  Config config = resolve(base);
  const std::uint64_t lines = num_lines(config);
  if (lines > kMaxRecordedLines) {
    reader.refuse(0, fmt::format("the caches of its recorded configuration have {} lines, more "
                                 "than the {} that a trace may ask for",
                                 lines, kMaxRecordedLines));
  }
  const std::uint64_t pixels = std::uint64_t{config.image.width} * config.image.height;
  if (reader.identity().kind == TraceKind::kRays &&
      pixels > reader.num_records() + kMaxPixelsWithoutRay) {
    reader.refuse(0, fmt::format("the picture of its recorded configuration has {} pixels, and it "
                                 "holds {} rays",
                                 pixels, reader.num_records()));
  }
  return {std::move(base), std::move(config)};
}

}  // namespace sheaf
