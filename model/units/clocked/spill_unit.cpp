// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/spill_unit.h"

#include <algorithm>

namespace sheaf::clocked {

StallCause SpillUnit::act(Cycles now) {
  take_lines(now);
  const bool sent = send_on(now);
  const bool moved = read_line(now) || write_line(now);
  const bool took = take_bundle(now);
  stats_.queue_occupancy_cycles += rays_queued_;
  if (sent || moved || took) return StallCause::kBusy;
  if (!queue_.empty()) return StallCause::kBlockedOutput;
  return reading_.empty() ? StallCause::kIdle : StallCause::kWaitingMemory;
}

void SpillUnit::take_lines(Cycles now) {
  while (from_l2_.has_arrived(now)) {
    const Address address = from_l2_.read(now).address;
    for (Held& held : reading_) {
      const bool its_own =
          address >= held.address && address < held.address + held.lines * spec_.line;
      if (its_own) ++held.read;
    }
  }
  while (!reading_.empty() && reading_.front().read == reading_.front().lines) {
    const Held& held = reading_.front();
    const Cycles latency = now - held.arrival;
    stats_.num_rays_returned += held.rays();
    stats_.sum_spill_latency += latency;
    stats_.max_spill_latency = std::max(stats_.max_spill_latency, latency);
    rays_in_memory_ -= held.rays();
    queue_.push_back(held);
    reading_.pop_front();
  }
}

bool SpillUnit::send_on(Cycles now) {
  if (queue_.empty()) return false;
  const Held& first = queue_.front();
  if (!out_bundles->write(first.bundle, now)) return false;
  rays_queued_ -= first.rays();
  stats_.sum_queue_residence += first.rays() * (now - first.queued);
  queue_.pop_front();
  return true;
}

bool SpillUnit::read_line(Cycles now) {
  const bool all_asked = reading_.empty() || reading_.back().moved == reading_.back().lines;
  if (all_asked) {
    if (spilled_.empty() || !fits(spilled_.front())) return false;
    reading_.push_back(spilled_.front());
    spilled_.pop_front();
    give_place(reading_.back(), now);
  }
  request(reading_.back(), false, now);
  ++stats_.num_lines_read;
  return true;
}

bool SpillUnit::write_line(Cycles now) {
  if (writing_.empty()) return false;
  Held& held = writing_.front();
  request(held, true, now);
  ++stats_.num_lines_written;
  if (held.moved == held.lines) {
    held.moved = 0;
    rays_in_memory_ += held.rays();
    stats_.max_rays_in_memory = std::max(stats_.max_rays_in_memory, rays_in_memory_);
    spilled_.push_back(held);
    writing_.clear();
  }
  return true;
}

bool SpillUnit::take_bundle(Cycles now) {
  if (!writing_.empty() || !in_bundles->has_arrived(now)) return false;
  Held held;
  held.bundle = in_bundles->read(now);
  held.arrival = now;
  ++stats_.num_bundles;
  stats_.num_rays += held.rays();
  if (spilled_.empty() && reading_.empty() && fits(held)) {
    stats_.num_rays_kept += held.rays();
    give_place(held, now);
    queue_.push_back(held);
    return true;
  }
  if (rays_in_memory_ == 0) next_address_ = spec_.base;
  held.address = next_address_;
  held.lines = (held.rays() * sheaf::SpillUnit::kRayBytes + spec_.line - 1) / spec_.line;
  next_address_ += held.lines * spec_.line;
  ++stats_.num_bundles_spilled;
  stats_.num_rays_spilled += held.rays();
  writing_.push_back(held);
  return true;
}

void SpillUnit::give_place(Held& held, Cycles now) {
  held.queued = now;
  rays_queued_ += held.rays();
  stats_.max_rays_queued = std::max(stats_.max_rays_queued, rays_queued_);
}

void SpillUnit::request(Held& held, bool write, Cycles now) {
  to_l2_.write({held.address + held.moved * spec_.line, static_cast<std::uint32_t>(spec_.line),
                spec_.requester, DataKind::kSpilledRay, write},
               now);
  ++held.moved;
}

}  // namespace sheaf::clocked
