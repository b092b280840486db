// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/build_plan.h"

namespace sheaf {

BuildPlan plan_machine(const Config& config, const SceneNeeds& needs) {
  BuildPlan plan;
  plan.heuristic = HeuristicChoice::parse(config.ray_cache.heuristic);
  const bool all = config.run.keep_all;
  const auto want = [&](bool needed, const char* what, const char* why) {
    if (!needed && !all) plan.left_out.push_back({what, why});
    return needed || all;
  };
  const bool bounces = config.render.recursion_level > 0;
  const char* const no_bounces = "the recursion level is 0";
  plan.shadow_rays = want(needs.lights, "shadow rays and post-shading", "the scene has no lights");
  plan.reflection_rays = want(needs.reflection && bounces, "reflection rays",
                              bounces ? "no material reflects" : no_bounces);
  plan.refraction_rays = want(needs.refraction && bounces, "refraction rays",
                              bounces ? "no material transmits" : no_bounces);
  plan.secondary_rays = want(plan.shadow_rays || plan.reflection_rays || plan.refraction_rays,
                             "packet FIFO", "no ray is ever spawned");
  const bool sorts = plan.heuristic.kind != HeuristicChoice::Kind::kNone ||
                     config.ray_cache.order != RayOrder::kArrival;
  plan.ray_cache = plan.secondary_rays && sorts;
  if (!plan.ray_cache) {
    plan.left_out.push_back(
        {"ray cache", sorts ? "no ray is ever spawned" : "the heuristic is none"});
  }
  plan.texture_cache =
      want(needs.textures, "texture cache and UVs", "no material in use has a texture");
  plan.shader_cache = config.shader_cache.cells != 0;
  if (!plan.shader_cache) plan.left_out.push_back({"shader cache", "shader_cache.cells is 0"});
  if (!config.measure.coherence) {
    plan.left_out.push_back({"coherence pass", "measure.coherence is false"});
  }
  if (config.image.heat_maps.empty()) {
    plan.left_out.push_back({"heat maps", "image.heat_maps is empty"});
  }
  return plan;
}

SorterOptions sorter_options(const Config& config, const BuildPlan& plan, const Box& scene_bounds) {
  SorterOptions options;
  options.heuristic = plan.heuristic;
  options.num_cells =
      config.ray_cache.cells != 0 ? config.ray_cache.cells : plan.heuristic.natural_cells();
  options.victim = config.ray_cache.victim;
  options.group_by_kind = config.ray_cache.group_by_kind;
  options.resident_voxels = config.ray_cache.resident_voxels;
  options.order = config.ray_cache.order;
  if (config.ray_cache.pos_relative && plan.heuristic.kind == HeuristicChoice::Kind::kPos) {
    const Vec3d diagonal(scene_bounds.extent());
    options.heuristic.x = *config.ray_cache.pos_relative * glm::dot(diagonal, diagonal);
  }
  return options;
}

}  // namespace sheaf
