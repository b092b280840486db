// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "shading/shading_source.h"
#include "tracefile/memory_recorder.h"
#include "units/primary_source.h"

namespace sheaf {

/// What a run may be given from outside: nothing, for a plain one.
struct RunHooks {
  ShadingSource* shading = nullptr;             ///< instead of computing it from the scene
  MemoryRecorder* memory = nullptr;             ///< takes down every access; timed runs only
  TileObserver* tiles = nullptr;                ///< told of the tiles as they begin
  std::vector<std::uint32_t> tile_choice = {};  ///< tiles to be simulated; empty: all
};

}  // namespace sheaf
