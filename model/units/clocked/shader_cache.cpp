// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/shader_cache.h"

#include <bit>

namespace sheaf::clocked {

void ShaderCache::tick(Cycles now) {
  if (now >= busy_until_) stalls_.switch_to(act(now), now);
}

StallCause ShaderCache::act(Cycles now) {
  while (!departures_.empty() && out_packets.write(departures_.front(), now)) {
    departures_.erase(departures_.begin());
  }
  if (!departures_.empty()) return StallCause::kBlockedOutput;
  const bool worked = accept_packet(now) || sweep(now);
  flow_.set_waiting_for_shader(sorter_.num_waiting(), now);
  if (worked) return StallCause::kBusy;
  return sorter_.num_waiting() != 0 ? StallCause::kWaitingInput : StallCause::kIdle;
}

bool ShaderCache::accept_packet(Cycles now) {
  if (!in_packets.has_arrived(now)) return false;
  RayPacket* packet = in_packets.read(now);
  const auto rays = static_cast<Cycles>(std::popcount(packet->active));
  busy_until_ = now + (rays + spec_.rays_per_cycle - 1) / spec_.rays_per_cycle;
  sorter_.insert(packet, departures_);
  return true;
}

bool ShaderCache::sweep(Cycles now) {
  if (sorter_.num_waiting() == 0 || !flow_.is_quiet(now)) return false;
  if (flow_.source(now) == FlowControl::Source::kIssuing) return false;
  sorter_.sweep(departures_);
  return true;
}

}  // namespace sheaf::clocked
