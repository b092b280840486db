// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/read_config.h"
#include "tracefile/trace_metadata.h"
#include "tracefile/trace_reader.h"

namespace sheaf {

/// Lines that all caches of a recorded machine may have together: a tag of each is held, in 16
/// bytes.
inline constexpr std::uint64_t kMaxRecordedLines = std::uint64_t{1} << 26;
/// Pixels that the picture of a trace of rays may have beyond one for each of its rays.
inline constexpr std::uint64_t kMaxPixelsWithoutRay = std::uint64_t{1} << 22;

/// The configuration that a trace was recorded under.
struct RecordedConfig {
  BaseConfig base;  ///< for resolve_config_over
  Config config;    ///< as it stands there
};

/// It comes with the file, so that it is not trusted as a user's own is: throws Error(kTrace) if it
/// asks for more lines or pixels than above, or is none.
[[nodiscard]] RecordedConfig recorded_config(const TraceReader& reader,
                                             const TraceMetadata& metadata);

}  // namespace sheaf
