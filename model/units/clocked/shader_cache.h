// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sorting/shading_sorter.h"
#include "stats/stall_account.h"
#include "units/clocked/link.h"
#include "units/flow_control.h"

namespace sheaf::clocked {

/// Regroups traced packets by what has to be fetched to shade them.
class ShaderCache {
 public:
  ShaderCache(std::string name, const ShaderCacheSpec& spec, const Scene& scene,
              PacketPool& packets, FlowControl& flow)
      : name_(std::move(name)), spec_(spec), sorter_(spec, scene, packets), flow_(flow) {}

  Inputs<RayPacket*> in_packets;    ///< one per traversal unit
  Outputs<RayPacket*> out_packets;  ///< one per shader unit

  void tick(Cycles now);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const ShadingSorter& sorter() const { return sorter_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }

 private:
  [[nodiscard]] StallCause act(Cycles now);
  bool accept_packet(Cycles now);
  bool sweep(Cycles now);

  const std::string name_;
  const ShaderCacheSpec spec_;
  ShadingSorter sorter_;
  FlowControl& flow_;
  std::vector<RayPacket*> departures_;
  Cycles busy_until_ = 0;  ///< taking a packet's rays in
  StallAccount stalls_;
};

}  // namespace sheaf::clocked
