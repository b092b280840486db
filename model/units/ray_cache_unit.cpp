// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/ray_cache_unit.h"

#include <fmt/format.h>

#include <algorithm>

namespace sheaf {

RayCacheUnit::RayCacheUnit(const sc_core::sc_module_name& name, const RayCacheSpec& spec,
                           std::unique_ptr<RaySorter> sorter, ObjectPool<SpawnBundle>& bundles,
                           FlowControl& flow, ClockDomain& domain)
    : sc_module(name),
      SteppingAgent(domain),
      in_bundles("in_bundles"),
      out_packets("out_packets"),
      spec_(spec),
      sorter_(std::move(sorter)),
      bundles_(bundles),
      flow_(flow) {
  inbox_.bind(domain, domain.add(*this));
  flow.bind_regrouper(inbox_);
}

void RayCacheUnit::end_of_elaboration() {
  in_bundles->set_consumer(inbox_);
  out_packets->add_producer(inbox_);
}

Cycles RayCacheUnit::act(Cycles now) {
  if (!send_departures(now)) {
    stalls_.switch_to(StallCause::kBlockedOutput, now);
    return kNever;  // woken when the FIFO has room
  }
  const bool worked = time_out(now) || insert_rays(now) || sweep(now);
  flow_.set_waiting(sorter_->num_waiting(), now);
  if (worked) {
    stalls_.switch_to(StallCause::kBusy, now);
    return now + 1;
  }
  stalls_.switch_to(sorter_->num_waiting() != 0 ? StallCause::kWaitingInput : StallCause::kIdle,
                    now);
  return std::min({in_bundles->next_arrival(), next_time_out(), flow_.next_notice(now)});
}

bool RayCacheUnit::send_departures(Cycles now) {
  while (num_sent_ < departures_.size()) {
    if (!out_packets->nb_write(departures_[num_sent_], now)) {
      out_packets->notify_when_free(inbox_);
      return false;
    }
    ++num_sent_;
  }
  departures_.clear();
  num_sent_ = 0;
  return true;
}

bool RayCacheUnit::insert_rays(Cycles now) {
  std::uint32_t room = spec_.rays_per_cycle;
  bool worked = false;
  while (room != 0 && departures_.empty()) {
    if (bundle_ == nullptr) {
      if (!in_bundles->has_arrived(now)) break;
      bundle_ = in_bundles->read(now);
      arrived_ = bundle_->cause;
      position_ = 0;
    }
    sorter_->insert(bundle_->rays[position_], now, departures_);
    explain_departures(arrived_, now);
    worked = true;
    --room;
    if (++position_ == bundle_->rays.size()) {
      bundle_->clear();
      bundles_.release(bundle_);
      bundle_ = nullptr;
    }
  }
  return worked;
}

bool RayCacheUnit::time_out(Cycles now) {
  if (next_time_out() > now) return false;
  sorter_->time_out(now - spec_.timeout, now, departures_);
  explain_departures(arrived_, now);
  return true;
}

Cycles RayCacheUnit::next_time_out() const {
  if (spec_.timeout == 0) return kNever;
  const Cycles oldest = sorter_->oldest_opening();
  return oldest == kNever ? kNever : oldest + spec_.timeout;
}

bool RayCacheUnit::sweep(Cycles now) {
  if (sorter_->num_waiting() == 0 || !flow_.is_quiet(now) || flow_.waits_for_shader(now)) {
    return false;
  }
  if (flow_.source(now) == FlowControl::Source::kIssuing) return false;
  sorter_->sweep(sweep_reason(now), now, departures_);
  if (recorder_ != nullptr) explain_departures(recorder_->begin_epoch(now), now);
  return true;
}

void RayCacheUnit::explain_departures(const AccessCause& cause, Cycles now) {
  if (recorder_ == nullptr) return;
  for (RayPacket* packet : departures_) {
    packet->cause = cause;
    packet->cause.sent = now + way_;
  }
}

Departure RayCacheUnit::sweep_reason(Cycles now) const {
  if (flow_.by_tile()) return Departure::kSweptTile;
  return flow_.source(now) == FlowControl::Source::kExhausted ? Departure::kSweptFrame
                                                              : Departure::kSweptStall;
}

std::string RayCacheUnit::stuck_reason() const {
  if (departures_.size() > num_sent_) {
    return fmt::format("{}: {} packets blocked by a full FIFO", name(),
                       departures_.size() - num_sent_);
  }
  if (sorter_->num_waiting() != 0) {
    return fmt::format("{}: {} rays waiting in cells", name(), sorter_->num_waiting());
  }
  return {};
}

}  // namespace sheaf
