// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/packet_arbiter.h"

#include <algorithm>
#include <bit>

namespace sheaf::clocked {

void PacketArbiter::tick(Cycles now) {
  stalls_.switch_to(act(now), now);
}

StallCause PacketArbiter::act(Cycles now) {
  while (in_free->has_arrived(now)) ++free_contexts_[in_free->read(now).unit];
  const bool primary = in_primary->has_arrived(now);
  const bool secondary = in_secondary != nullptr && in_secondary->has_arrived(now);
  if (!primary && !secondary) return StallCause::kIdle;
  const auto freest = std::max_element(free_contexts_.begin(), free_contexts_.end());
  if (*freest == 0) return StallCause::kBlockedOutput;
  const bool prefers_secondary =
      spec_.policy == ArbiterPolicy::kSecondaryFirst ||
      (spec_.policy == ArbiterPolicy::kAlternate && !last_was_secondary_);
  const bool chosen_secondary = primary && secondary ? prefers_secondary : secondary;
  RayPacket* packet = chosen_secondary ? in_secondary->read(now) : in_primary->read(now);
  const auto rays = static_cast<std::uint64_t>(std::popcount(packet->active));
  last_was_secondary_ = chosen_secondary;
  ++(chosen_secondary ? stats_.num_secondary_packets : stats_.num_primary_packets);
  (chosen_secondary ? stats_.num_secondary_rays : stats_.num_primary_rays) += rays;
  --*freest;
  out_packets[static_cast<std::size_t>(freest - free_contexts_.begin())]->write(packet, now);
  return StallCause::kBusy;
}

}  // namespace sheaf::clocked
