// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>
#include <vector>

#include "base/object_pool.h"
#include "channels/stepping_agent.h"
#include "channels/timed_channel.h"
#include "sorting/spawn_bundle.h"
#include "stats/counters.h"
#include "stats/stall_account.h"

namespace sheaf {

#define SHEAF_SPAWN_ROUTER_COUNTERS(X)                            \
  X(num_bundles, "bundles", "Packets whose spawned rays came in") \
  X(num_packets, "packets", "Packets sent on, one a kind of ray") \
  X(num_rays, "rays", "Rays in these packets")
SHEAF_STATS(SpawnRouterStats, SHEAF_SPAWN_ROUTER_COUNTERS);

/// Takes the ray cache's place for the heuristic `none`: the rays that one packet spawned travel on
/// as packets by kind, one packet a cycle.
class SpawnRouter final : public sc_core::sc_module, public SteppingAgent {
 public:
  SpawnRouter(const sc_core::sc_module_name& name, PacketPool& packets,
              ObjectPool<SpawnBundle>& bundles, ClockDomain& domain);

  sc_core::sc_port<TimedIn<SpawnBundle*>> in_bundles;
  sc_core::sc_port<TimedOut<RayPacket*>> out_packets;

  [[nodiscard]] std::string stuck_reason() const override;

  /// Packets carry their cause; they reach a traversal unit `way` later at the earliest.
  void record_way(Cycles way) { way_ = way; }

  [[nodiscard]] const SpawnRouterStats& stats() const { return stats_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }

 private:
  void end_of_elaboration() override;
  Cycles act(Cycles now) override;

  PacketPool& packets_;
  ObjectPool<SpawnBundle>& bundles_;
  Inbox inbox_;
  std::vector<RayPacket*> waiting_;  ///< in reverse order
  SpawnRouterStats stats_;
  StallAccount stalls_;
  Cycles way_ = 0;
};

}  // namespace sheaf
