// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/shading_source.h"
#include "tracefile/memory_recorder.h"

namespace sheaf {

/// What a run may be given from outside: nothing, for a plain one.
struct RunHooks {
  ShadingSource* shading = nullptr;  ///< instead of computing it from the scene
  MemoryRecorder* memory = nullptr;  ///< takes down every access; timed runs only
};

}  // namespace sheaf
