// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/trace_command.h"
#include "tracefile/trace_metadata.h"

namespace sheaf {

/// Writes a memory trace as text. Cycles are those of the machine's core. Throws Error(kTrace) for
/// a trace that is not as it should be, Error(kOutput) if the text cannot be written; then no file
/// is left.
void export_trace(const TraceOptions& options, TraceReader& reader, const TraceMetadata& metadata);

}  // namespace sheaf
