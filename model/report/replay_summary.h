// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "stats/report_tree.h"
#include "tracefile/trace_metadata.h"

namespace sheaf {

/// One page on the replay of a memory trace.
[[nodiscard]] std::string summarize_replay(const StatsTree& stats, const TraceMetadata& metadata,
                                           const std::string& mode);

}  // namespace sheaf
