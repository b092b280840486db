// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>
#include <vector>

#include "channels/stepping_agent.h"
#include "channels/timed_channel.h"
#include "config/config.h"
#include "stats/counters.h"
#include "stats/stall_account.h"
#include "traversal/ray_packet.h"
#include "units/messages.h"

namespace sheaf {

#define SHEAF_ARBITER_COUNTERS(X)                                                       \
  X(num_primary_packets, "packets", "Primary packets given to a traversal context")     \
  X(num_secondary_packets, "packets", "Secondary packets given to a traversal context") \
  X(num_primary_rays, "rays", "Rays in the primary packets")                            \
  X(num_secondary_rays, "rays", "Rays in the secondary packets")
SHEAF_STATS(ArbiterStats, SHEAF_ARBITER_COUNTERS);

/// Chooses the next packet for a free traversal context, one a cycle: of the two sources by policy,
/// of the traversal units the one with most free contexts (of equals the lowest).
class PacketArbiter final : public sc_core::sc_module, public SteppingAgent {
 public:
  PacketArbiter(const sc_core::sc_module_name& name, const ArbiterSpec& spec,
                std::uint32_t num_units, std::uint32_t contexts_per_unit, ClockDomain& domain);

  sc_core::sc_port<TimedIn<RayPacket*>> in_primary;
  /// Unbound if the scene has no secondary rays.
  sc_core::sc_port<TimedIn<RayPacket*>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> in_secondary;
  sc_core::sc_port<TimedIn<ContextFree>> in_free;
  sc_core::sc_port<TimedOut<RayPacket*>, 0> out_packets;  ///< one per traversal unit

  [[nodiscard]] std::string stuck_reason() const override;

  [[nodiscard]] const ArbiterStats& stats() const { return stats_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }

 private:
  void end_of_elaboration() override;
  Cycles act(Cycles now) override;
  [[nodiscard]] bool choose_secondary(bool has_primary, bool has_secondary) const;
  void dispatch(RayPacket* packet, bool secondary, std::size_t unit, Cycles now);

  const ArbiterSpec spec_;
  Inbox inbox_;
  TimedIn<RayPacket*>* secondary_ = nullptr;
  std::vector<std::uint32_t> free_contexts_;  ///< of each traversal unit
  bool last_was_secondary_ = true;
  ArbiterStats stats_;
  StallAccount stalls_;
};

}  // namespace sheaf
