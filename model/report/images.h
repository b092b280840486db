// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "geometry/vec.h"
#include "report/result_folder.h"
#include "system/frame.h"

namespace sheaf {

/// Stages image.exr (beauty, albedo, normal, depth and the heat maps asked for), image.png and a
/// false-colour PNG of each heat map.
void write_images(const Config& config, const Frame& frame, ResultFolder& folder);

}  // namespace sheaf
