// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/packet_arbiter.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace sheaf {

PacketArbiter::PacketArbiter(const sc_core::sc_module_name& name, const ArbiterSpec& spec,
                             std::uint32_t num_units, std::uint32_t contexts_per_unit,
                             ClockDomain& domain)
    : sc_module(name),
      SteppingAgent(domain),
      in_primary("in_primary"),
      in_secondary("in_secondary"),
      in_free("in_free"),
      out_packets("out_packets"),
      spec_(spec),
      free_contexts_(num_units, contexts_per_unit) {
  inbox_.bind(domain, domain.add(*this));
}

void PacketArbiter::end_of_elaboration() {
  in_primary->set_consumer(inbox_);
  in_free->set_consumer(inbox_);
  for (int i = 0; i < out_packets.size(); ++i) out_packets[i]->add_producer(inbox_);
  if (in_secondary.size() != 0) {
    secondary_ = in_secondary[0];
    secondary_->set_consumer(inbox_);
  }
}

Cycles PacketArbiter::act(Cycles now) {
  while (in_free->has_arrived(now)) ++free_contexts_[in_free->read(now).unit];
  const bool has_primary = in_primary->has_arrived(now);
  const bool has_secondary = secondary_ != nullptr && secondary_->has_arrived(now);
  const auto freest = std::max_element(free_contexts_.begin(), free_contexts_.end());
  const bool has_context = *freest != 0;
  if (has_context && (has_primary || has_secondary)) {
    const bool secondary = choose_secondary(has_primary, has_secondary);
    RayPacket* packet = secondary ? secondary_->read(now) : in_primary->read(now);
    dispatch(packet, secondary, static_cast<std::size_t>(freest - free_contexts_.begin()), now);
    stalls_.switch_to(StallCause::kBusy, now);
    return now + 1;
  }
  const bool has_packet = has_primary || has_secondary;
  stalls_.switch_to(has_packet ? StallCause::kBlockedOutput : StallCause::kIdle, now);
  // What has come already waits for a context; what comes later is at least accounted for.
  const Cycles next_primary = has_primary ? kNever : in_primary->next_arrival();
  const Cycles next_secondary =
      secondary_ == nullptr || has_secondary ? kNever : secondary_->next_arrival();
  return std::min({in_free->next_arrival(), next_primary, next_secondary});
}

bool PacketArbiter::choose_secondary(bool has_primary, bool has_secondary) const {
  if (!has_primary || !has_secondary) return has_secondary;
  switch (spec_.policy) {
    case ArbiterPolicy::kAlternate:
      return !last_was_secondary_;
    case ArbiterPolicy::kPrimaryFirst:
      return false;
    case ArbiterPolicy::kSecondaryFirst:
      return true;
  }
  return false;
}

void PacketArbiter::dispatch(RayPacket* packet, bool secondary, std::size_t unit, Cycles now) {
  const auto rays = static_cast<std::uint64_t>(std::popcount(packet->active));
  last_was_secondary_ = secondary;
  ++(secondary ? stats_.num_secondary_packets : stats_.num_primary_packets);
  (secondary ? stats_.num_secondary_rays : stats_.num_primary_rays) += rays;
  --free_contexts_[unit];
  // The link has room for every context of its unit.
  out_packets[static_cast<int>(unit)]->nb_write(packet, now);
}

std::string PacketArbiter::stuck_reason() const {
  const bool waiting = in_primary->next_arrival() != kNever ||
                       (secondary_ != nullptr && secondary_->next_arrival() != kNever);
  if (!waiting) return {};
  return fmt::format("{}: packets wait for a free traversal context", name());
}

}  // namespace sheaf
