// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "scene/scene.h"
#include "sorting/ray_sorter.h"

namespace sheaf {

/// Which parts of the machine a run builds. Everything that the scene and the configuration do not
/// need is left out.
struct BuildPlan {
  bool shadow_rays = false;
  bool reflection_rays = false;
  bool refraction_rays = false;
  bool secondary_rays = false;  ///< any of these: packet FIFO, and ray cache or spawn router
  bool ray_cache = false;       ///< else, with secondary rays, the spawn router of `none`
  bool texture_cache = false;
  bool shader_cache = false;
  HeuristicChoice heuristic;

  struct LeftOut {
    std::string what;
    std::string why;
  };
  std::vector<LeftOut> left_out;
};

/// Throws Error(kUsage) for a heuristic that does not exist.
[[nodiscard]] BuildPlan plan_machine(const Config& config, const SceneNeeds& needs);

/// The ray cache's size, policy and heuristic, with pos.relative turned into scene units.
[[nodiscard]] SorterOptions sorter_options(const Config& config, const BuildPlan& plan,
                                           const Box& scene_bounds);

}  // namespace sheaf
