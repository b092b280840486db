// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "memory/dram/trace_run.h"

namespace sheaf {

/// What `sheaf memory` prints: one page for people. `source` names the trace or the stream.
[[nodiscard]] std::string summarize_memory(const TraceRun& run, const std::string& source);

}  // namespace sheaf
