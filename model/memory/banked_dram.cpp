// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/banked_dram.h"

#include <fmt/format.h>

#include <algorithm>

#include "memory/dram/dram_report.h"

namespace sheaf {

BankedDram::BankedDram(const sc_core::sc_module_name& name, const DramDevice& device,
                       double core_hz, ClockDomain& domain)
    : MainMemory(name),
      memory_(device),
      to_memory_(ClockRatio::whole_hertz(core_hz), device.clock_hz),
      to_core_(device.clock_hz, ClockRatio::whole_hertz(core_hz)),
      shortest_latency_(std::min(device.timing.tCL, device.timing.tCWL) + device.timing.tBL),
      domain_(domain) {
  inbox_.bind(domain, domain.add(*this));
}

tlm::tlm_sync_enum BankedDram::nb_transport_fw(tlm::tlm_generic_payload& payload,
                                               tlm::tlm_phase& phase, sc_core::sc_time& delay) {
  if (phase != tlm::BEGIN_REQ) return tlm::TLM_ACCEPTED;
  const Cycles now = domain_.cycle_at_kernel_offset(delay);
  const bool write = payload.is_write();
  const Bytes bytes = payload.get_data_length();
  ++(write ? stats_.num_writes : stats_.num_reads);
  (write ? stats_.bytes_written : stats_.bytes_read) += bytes;
  memory_.push({.arrival = std::max(to_memory_.up(now), advanced_to_),
                .address = payload.get_address(),
                .bytes = bytes,
                .write = write,
                .id = now,
                .user = &payload});
  inbox_.nudge(next_wake());
  phase = tlm::END_REQ;
  return tlm::TLM_UPDATED;
}

// No data can come before this one's successor.
Cycles BankedDram::next_wake() const {
  const Cycles next = memory_.next_event();
  return next == kNever ? kNever : to_core_.up(next + shortest_latency_) - 1;
}

Cycles BankedDram::wake(Cycles now) {
  for (;;) {
    // Whoever acts at this core cycle calls for a later one.
    advanced_to_ = std::max(advanced_to_, to_memory_.up(now + 1));
    memory_.advance(advanced_to_, [this](const DramSystem::Done& done) { answer(done); });
    const Cycles next = next_wake();
    if (next >= domain_.horizon()) return next;
    now = next;
  }
}

void BankedDram::answer(const DramSystem::Done& done) {
  const Cycles at = to_core_.up(done.at);
  if (!done.write) {
    stats_.sum_read_latency += at - done.id;
    stats_.max_read_latency = std::max(stats_.max_read_latency, at - done.id);
  }
  auto& payload = *static_cast<tlm::tlm_generic_payload*>(done.user);
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  tlm::tlm_phase phase = tlm::BEGIN_RESP;
  sc_core::sc_time delay = domain_.offset(at);
  static_cast<void>(from_cache->nb_transport_bw(payload, phase, delay));
}

Cycles BankedDram::memory_end(Cycles end) const {
  return std::max(to_memory_.up(end), memory_.now() + 1);
}

DramStats BankedDram::stats(Cycles end) const {
  DramStats stats = stats_;
  const std::uint64_t busy = memory_.stats(memory_end(end)).bus_busy_cycles;
  stats.bus_busy_cycles = to_core_.up(busy / memory_.num_channels());
  return stats;
}

void BankedDram::report_details(const std::string& path, Cycles end, StatsTree& stats) const {
  const Cycles memory_cycles = memory_end(end);
  report_dram(path, memory_.device(), memory_.stats(memory_cycles), memory_cycles, stats);
}

std::string BankedDram::stuck_reason() const {
  if (memory_.is_idle()) return {};
  return fmt::format("{}: requests under way", name());
}

}  // namespace sheaf
