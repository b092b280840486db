// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "stats/stall_account.h"
#include "units/clocked/link.h"
#include "units/messages.h"
#include "units/packet_arbiter.h"

namespace sheaf::clocked {

/// Gives one packet a cycle to the traversal unit with most free contexts, of equals the lowest.
class PacketArbiter {
 public:
  PacketArbiter(std::string name, const ArbiterSpec& spec, const UnitSpec& traversal_unit)
      : name_(std::move(name)),
        spec_(spec),
        free_contexts_(traversal_unit.count, traversal_unit.contexts) {}

  Link<RayPacket*>* in_primary = nullptr;
  Link<RayPacket*>* in_secondary = nullptr;  ///< null if the scene has no secondary rays
  Link<ContextFree>* in_free = nullptr;
  std::vector<Link<RayPacket*>*> out_packets;  ///< one per traversal unit

  void tick(Cycles now);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const ArbiterStats& stats() const { return stats_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }

 private:
  [[nodiscard]] StallCause act(Cycles now);

  const std::string name_;
  const ArbiterSpec spec_;
  std::vector<std::uint32_t> free_contexts_;  ///< of each traversal unit
  bool last_was_secondary_ = true;
  ArbiterStats stats_;
  StallAccount stalls_;
};

}  // namespace sheaf::clocked
