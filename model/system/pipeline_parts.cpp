// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/pipeline_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.h"

namespace sheaf {
namespace {

WorstCase worst_case(const Config& config, const BuildPlan& plan, const Scene& scene) {
  const auto lights = static_cast<std::uint32_t>(plan.shadow_rays ? scene.lights.size() : 0);
  const std::uint32_t branches =
      (plan.reflection_rays ? 1U : 0U) + (plan.refraction_rays ? 1U : 0U);
  return {config.render.recursion_level, lights, branches};
}

std::uint64_t credits(const Config& config, const WorstCase& worst) {
  const std::uint64_t one_ray = worst.of({});
  const std::uint64_t one_packet = one_ray * config.packet.size;
  const std::uint64_t tile = std::uint64_t{config.flow.tile_size} * config.flow.tile_size;
  if (config.flow.credits == 0) return std::max(one_packet, one_ray * tile);
  if (config.flow.control == FlowPolicy::kCredits && config.flow.credits < one_packet) {
    throw Error(ExitCode::kUsage,
                fmt::format("flow.credits = {}: the worst case of one primary packet is {} rays; "
                            "give at least that many, or 0 for the worst case of a tile",
                            config.flow.credits, one_packet));
  }
  return config.flow.credits;
}

}  // namespace

FlowControl make_flow_control(const Config& config, const BuildPlan& plan, const Scene& scene) {
  const WorstCase worst = worst_case(config, plan, scene);
  return {config.flow, worst, credits(config, worst)};
}

std::uint32_t tiles_in_flight(const Config& config, const BuildPlan& plan, const Scene& scene) {
  if (config.flow.control == FlowPolicy::kTile) return 0;
  const WorstCase worst = worst_case(config, plan, scene);
  const std::uint64_t tile =
      worst.of({}) * std::uint64_t{config.flow.tile_size} * config.flow.tile_size;
  const std::uint64_t tiles = (credits(config, worst) + tile - 1) / tile;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(tiles, ~std::uint32_t{0} / 2));
}

PacketShader make_shader(const Config& config, const Scene& scene, Frame& frame) {
  return {scene,
          {config.render.recursion_level, static_cast<float>(config.render.weight_cutoff)},
          &frame.layers};
}

TraversalScheme scheme_of(Scheme scheme) {
  switch (scheme) {
    case Scheme::kSingle:
      return TraversalScheme::kSingle;
    case Scheme::kMasked:
      return TraversalScheme::kMasked;
    case Scheme::kInterval:
      return TraversalScheme::kInterval;
    case Scheme::kIntervalEntry:
      return TraversalScheme::kIntervalEntry;
    case Scheme::kOmni:
      return TraversalScheme::kOmni;
  }
  return TraversalScheme::kMasked;
}

}  // namespace sheaf
