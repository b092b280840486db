// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>

#include "apps/replay_command.h"
#include "config/config.h"
#include "tracefile/trace_metadata.h"

namespace sheaf {

inline constexpr std::array<std::pair<const char*, ReplayMode>, 2> kReplayModes{
    {{"elastic", ReplayMode::kElastic}, {"fixed", ReplayMode::kFixed}}};

/// Replays a memory trace on the caches and the memory of a configuration. Returns an exit code;
/// throws Error for what the user can mend.
int replay_memory(const ReplayOptions& options, const Config& config, TraceReader& reader,
                  const TraceMetadata& metadata);

/// Whether a memory trace can be replayed with another value of this parameter.
[[nodiscard]] bool shapes_memory_only(std::string_view key);

}  // namespace sheaf
