// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/machine_parts.h"

#include <utility>

#include "system/clocked_machine.h"
#include "system/machine.h"
#include "system/pipeline_parts.h"

namespace sheaf {

template <typename Kind>
MachineParts<Kind>::MachineParts(const Config& config, const BuildPlan& plan,
                                 const PreparedScene& scene, Frame& frame, RunHooks hooks)
    : config_(config),
      plan_(plan),
      scene_(scene),
      frame_(frame),
      packets_(static_cast<int>(config.packet.size)),
      shader_(make_shader(config, scene.scene, frame)),
      hooks_(std::move(hooks)),
      flow_(make_flow_control(config, plan, scene.scene)) {}

template <typename Kind>
MachineParts<Kind>::~MachineParts() = default;

template <typename Kind>
void MachineParts<Kind>::finish_accounts(Cycles end) {
  for (auto& unit : traversal_units_) unit->finish(end);
  for (auto& unit : intersection_units_) unit->finish(end);
  for (auto& unit : shader_units_) unit->finish(end);
  primary_source_->finish(end);
  packet_arbiter_->finish(end);
  film_->finish(end);
  if (shader_cache_) shader_cache_->finish(end);
  if (ray_cache_) ray_cache_->finish(end);
  if (spawn_router_) spawn_router_->finish(end);
  if (spill_) spill_->finish(end);
}

template class MachineParts<TimedKind>;
template class MachineParts<ClockedKind>;

}  // namespace sheaf
