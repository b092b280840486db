// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "config/config.h"
#include "image/film.h"
#include "shading/packet_shader.h"
#include "units/ray_counts.h"
#include "units/traversal_unit.h"

namespace sheaf {

/// What a run leaves behind besides its statistics.
struct Frame {
  explicit Frame(const Config& config);

  std::unique_ptr<Film> film;
  AuxiliaryLayers layers;
  HeatMaps heat;
  RayCounts rays;
};

}  // namespace sheaf
