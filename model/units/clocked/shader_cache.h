// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sorting/shading_sorter.h"
#include "units/clocked/link.h"
#include "units/clocked/unit.h"
#include "units/flow_control.h"

namespace sheaf::clocked {

/// Regroups traced packets by what has to be fetched to shade them.
class ShaderCache final : public Unit {
 public:
  ShaderCache(std::string name, const ShaderCacheSpec& spec, const Scene& scene,
              PacketPool& packets, FlowControl& flow)
      : Unit(std::move(name)), spec_(spec), sorter_(spec, scene, packets), flow_(flow) {}

  Inputs<RayPacket*> in_packets;    ///< one per traversal unit
  Outputs<RayPacket*> out_packets;  ///< one per shader unit

  [[nodiscard]] const ShadingSorter& sorter() const { return sorter_; }

 private:
  StallCause act(Cycles now) override;
  bool accept_packet(Cycles now);
  bool sweep(Cycles now);

  const ShaderCacheSpec spec_;
  ShadingSorter sorter_;
  FlowControl& flow_;
  std::vector<RayPacket*> departures_;
  Cycles busy_until_ = 0;  ///< taking a packet's rays in
};

}  // namespace sheaf::clocked
