// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/shader_cache_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace sheaf {

ShaderCacheUnit::ShaderCacheUnit(const sc_core::sc_module_name& name, const ShaderCacheSpec& spec,
                                 const Scene& scene, PacketPool& packets, FlowControl& flow,
                                 ClockDomain& domain)
    : sc_module(name),
      SteppingAgent(domain),
      in_packets("in_packets"),
      out_packets("out_packets"),
      spec_(spec),
      sorter_(spec, scene, packets),
      flow_(flow) {
  inbox_.bind(domain, domain.add(*this));
  flow.bind_shader_cache(inbox_);
}

void ShaderCacheUnit::end_of_elaboration() {
  inputs_.bind(in_packets, inbox_);
  outputs_.bind(out_packets, inbox_);
}

Cycles ShaderCacheUnit::act(Cycles now) {
  if (now < busy_until_) return busy_until_;
  if (!send_departures(now)) {
    stalls_.switch_to(StallCause::kBlockedOutput, now);
    return kNever;  // woken when a shader unit has room
  }
  const bool worked = accept_packet(now) || sweep(now);
  flow_.set_waiting_for_shader(sorter_.num_waiting(), now);
  if (worked) {
    stalls_.switch_to(StallCause::kBusy, now);
    return std::max(busy_until_, now + 1);
  }
  stalls_.switch_to(sorter_.num_waiting() != 0 ? StallCause::kWaitingInput : StallCause::kIdle,
                    now);
  return std::min(inputs_.next_arrival(), flow_.next_notice(now));
}

bool ShaderCacheUnit::send_departures(Cycles now) {
  while (num_sent_ < departures_.size()) {
    if (outputs_.write(departures_[num_sent_], now, true, inbox_) != Sent::kYes) return false;
    ++num_sent_;
  }
  departures_.clear();
  num_sent_ = 0;
  return true;
}

bool ShaderCacheUnit::accept_packet(Cycles now) {
  RayPacket* packet = nullptr;
  if (!inputs_.read(packet, now)) return false;
  const auto rays = static_cast<Cycles>(std::popcount(packet->active));
  busy_until_ = now + (rays + spec_.rays_per_cycle - 1) / spec_.rays_per_cycle;
  const AccessCause cause = packet->cause;
  sorter_.insert(packet, departures_);
  explain_departures(cause, now);
  return true;
}

bool ShaderCacheUnit::sweep(Cycles now) {
  if (sorter_.num_waiting() == 0 || !flow_.is_quiet(now)) return false;
  if (flow_.source(now) == FlowControl::Source::kIssuing) return false;
  sorter_.sweep(departures_);
  if (recorder_ != nullptr) explain_departures(recorder_->begin_epoch(now), now);
  return true;
}

void ShaderCacheUnit::explain_departures(const AccessCause& cause, Cycles now) {
  if (recorder_ == nullptr) return;
  for (RayPacket* packet : departures_) {
    packet->cause = cause;
    packet->cause.sent = now;
  }
}

std::string ShaderCacheUnit::stuck_reason() const {
  if (departures_.size() > num_sent_) {
    return fmt::format("{}: {} packets blocked by full links", name(),
                       departures_.size() - num_sent_);
  }
  if (sorter_.num_waiting() != 0) {
    return fmt::format("{}: {} rays waiting in cells", name(), sorter_.num_waiting());
  }
  return {};
}

}  // namespace sheaf
