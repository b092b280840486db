// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.h"
#include "system/build_plan.h"
#include "system/frame.h"
#include "traversal/trace.h"
#include "units/flow_control.h"

namespace sheaf {

// What the timed machine and the untimed pipeline derive from the configuration in the same way.

/// Throws Error(kUsage) if flow.credits cannot admit a single primary packet.
[[nodiscard]] FlowControl make_flow_control(const Config& config, const BuildPlan& plan,
                                            const Scene& scene);

/// Tiles besides the current one that can have rays in flight: none with tile flow control.
[[nodiscard]] std::uint32_t tiles_in_flight(const Config& config, const BuildPlan& plan,
                                            const Scene& scene);

/// Shades what the machine traces; the primary hits' layers go to the frame.
[[nodiscard]] PacketShader make_shader(const Config& config, const Scene& scene, Frame& frame);

[[nodiscard]] TraversalScheme scheme_of(Scheme scheme);

}  // namespace sheaf
