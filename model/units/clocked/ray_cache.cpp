// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/ray_cache.h"

namespace sheaf::clocked {

void RayCache::tick(Cycles now) {
  stalls_.switch_to(act(now), now);
}

StallCause RayCache::act(Cycles now) {
  while (!departures_.empty() && out_packets->write(departures_.front(), now)) {
    departures_.erase(departures_.begin());
  }
  if (!departures_.empty()) return StallCause::kBlockedOutput;
  const bool worked = time_out(now) || insert_rays(now) || sweep(now);
  flow_.set_waiting(sorter_->num_waiting(), now);
  if (worked) return StallCause::kBusy;
  return sorter_->num_waiting() != 0 ? StallCause::kWaitingInput : StallCause::kIdle;
}

Cycles RayCache::next_time_out() const {
  const Cycles oldest = sorter_->oldest_opening();
  return spec_.timeout == 0 || oldest == kNever ? kNever : oldest + spec_.timeout;
}

bool RayCache::time_out(Cycles now) {
  if (next_time_out() > now) return false;
  sorter_->time_out(now - spec_.timeout, now, departures_);
  return true;
}

// Of the rays of a cycle those behind a departure wait for the next cycle.
bool RayCache::insert_rays(Cycles now) {
  std::uint32_t taken = 0;
  while (taken != spec_.rays_per_cycle && departures_.empty()) {
    if (bundle_ == nullptr && !in_bundles->has_arrived(now)) break;
    if (bundle_ == nullptr) bundle_ = in_bundles->read(now);
    sorter_->insert(bundle_->rays[position_++], now, departures_);
    ++taken;
    if (position_ == bundle_->rays.size()) {
      bundle_->clear();
      bundles_.release(bundle_);
      bundle_ = nullptr;
      position_ = 0;
    }
  }
  return taken != 0;
}

bool RayCache::sweep(Cycles now) {
  if (sorter_->num_waiting() == 0 || !flow_.is_quiet(now) || flow_.waits_for_shader(now)) {
    return false;
  }
  const FlowControl::Source source = flow_.source(now);
  if (source == FlowControl::Source::kIssuing) return false;
  const Departure why = flow_.by_tile()                             ? Departure::kSweptTile
                        : source == FlowControl::Source::kExhausted ? Departure::kSweptFrame
                                                                    : Departure::kSweptStall;
  sorter_->sweep(why, now, departures_);
  return true;
}

}  // namespace sheaf::clocked
