// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/spill_unit.h"

#include <fmt/format.h>

#include <algorithm>

namespace sheaf {

SpillUnit::SpillUnit(const sc_core::sc_module_name& name, const Spec& spec,
                     TimedOut<LineRequest>& requests, ClockDomain& domain)
    : sc_module(name),
      SteppingAgent(domain),
      in_bundles("in_bundles"),
      out_bundles("out_bundles"),
      in_lines("in_lines"),
      spec_(spec),
      requests_(requests),
      next_address_(spec.base) {
  inbox_.bind(domain, domain.add(*this));
}

void SpillUnit::end_of_elaboration() {
  in_bundles->set_consumer(inbox_);
  in_lines->set_consumer(inbox_);
  out_bundles->add_producer(inbox_);
  requests_.add_producer(inbox_);
}

Cycles SpillUnit::act(Cycles now) {
  take_lines(now);
  const bool sent = send_on(now);
  const bool moved = use_memory_port(now);
  const bool took = take_bundle(now);
  if (sent || moved || took) {
    stalls_.switch_to(StallCause::kBusy, now);
    return now + 1;
  }
  if (!queue_.empty()) {
    stalls_.switch_to(StallCause::kBlockedOutput, now);
  } else {
    stalls_.switch_to(returning_.empty() ? StallCause::kIdle : StallCause::kWaitingMemory, now);
  }
  const Cycles next_bundle = writing_.bundle == nullptr ? in_bundles->next_arrival() : kNever;
  return std::min(next_bundle, in_lines->next_arrival());
}

void SpillUnit::take_lines(Cycles now) {
  while (in_lines->has_arrived(now)) {
    const Address address = in_lines->read(now).address;
    const auto owner = std::ranges::find_if(returning_, [&](const Held& held) {
      return address >= held.address && address < held.address + held.num_lines * spec_.line;
    });
    --owner->missing;
  }
  while (!returning_.empty() && returning_.front().missing == 0) {
    const Held& held = returning_.front();
    rays_in_memory_ -= held.rays();
    stats_.num_rays_returned += held.rays();
    const Cycles latency = now - held.arrival;
    stats_.sum_spill_latency += latency;
    stats_.max_spill_latency = std::max(stats_.max_spill_latency, latency);
    queue_.push_back(held);
    returning_.pop_front();
  }
}

bool SpillUnit::send_on(Cycles now) {
  if (queue_.empty()) return false;
  const Held& first = queue_.front();
  if (!out_bundles->nb_write(first.bundle, now)) {
    out_bundles->notify_when_free(inbox_);
    return false;
  }
  const std::size_t rays = first.rays();
  stats_.sum_queue_residence += rays * (now - first.queued);
  queue_.pop_front();
  change_queue(-static_cast<std::ptrdiff_t>(rays), now);
  return true;
}

// One request a cycle.
bool SpillUnit::use_memory_port(Cycles now) {
  return read_back(now) || write_out(now);
}

bool SpillUnit::read_back(Cycles now) {
  const bool all_asked =
      returning_.empty() || returning_.back().requested == returning_.back().num_lines;
  if (all_asked) {
    if (spilled_.empty() || !fits(spilled_.front().rays())) return false;
    returning_.push_back(spilled_.front());
    spilled_.pop_front();
    reserve(returning_.back(), now);
  }
  Held& held = returning_.back();
  request(held, false, now);
  ++held.requested;
  ++stats_.num_lines_read;
  return true;
}

bool SpillUnit::write_out(Cycles now) {
  if (writing_.bundle == nullptr) return false;
  request(writing_, true, now);
  ++stats_.num_lines_written;
  if (++writing_.requested < writing_.num_lines) return true;
  writing_.requested = 0;
  writing_.missing = writing_.num_lines;
  rays_in_memory_ += writing_.rays();
  stats_.max_rays_in_memory = std::max<std::uint64_t>(stats_.max_rays_in_memory, rays_in_memory_);
  spilled_.push_back(writing_);
  writing_ = {};
  return true;
}

bool SpillUnit::take_bundle(Cycles now) {
  if (writing_.bundle != nullptr || !in_bundles->has_arrived(now)) return false;
  Held held;
  held.bundle = in_bundles->read(now);
  held.arrival = now;
  ++stats_.num_bundles;
  stats_.num_rays += held.rays();
  if (spilled_.empty() && returning_.empty() && fits(held.rays())) {
    stats_.num_rays_kept += held.rays();
    reserve(held, now);
    queue_.push_back(held);
    return true;
  }
  if (rays_in_memory_ == 0) next_address_ = spec_.base;
  held.address = next_address_;
  held.num_lines =
      static_cast<std::uint32_t>((held.rays() * kRayBytes + spec_.line - 1) / spec_.line);
  next_address_ += held.num_lines * spec_.line;
  ++stats_.num_bundles_spilled;
  stats_.num_rays_spilled += held.rays();
  writing_ = held;
  return true;
}

void SpillUnit::reserve(Held& held, Cycles now) {
  held.queued = now;
  change_queue(static_cast<std::ptrdiff_t>(held.rays()), now);
  stats_.max_rays_queued = std::max<std::uint64_t>(stats_.max_rays_queued, rays_queued_);
}

void SpillUnit::change_queue(std::ptrdiff_t rays, Cycles now) {
  stats_.queue_occupancy_cycles += rays_queued_ * (now - counted_until_);
  counted_until_ = now;
  rays_queued_ += static_cast<std::size_t>(rays);
}

void SpillUnit::request(const Held& held, bool write, Cycles now) {
  requests_.write_ahead(
      {held.address + held.requested * spec_.line, static_cast<std::uint32_t>(spec_.line),
       spec_.requester, DataKind::kSpilledRay, write, false},
      now, spec_.requester);
}

std::string SpillUnit::stuck_reason() const {
  if (is_idle()) return {};
  return fmt::format("{}: {} rays queued, {} in memory", name(), rays_queued_, rays_in_memory_);
}

}  // namespace sheaf
