// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/fixed_dram.h"

#include <algorithm>

namespace sheaf {

FixedDram::FixedDram(const sc_core::sc_module_name& name, const DramSpec& spec,
                     const ClockDomain& domain)
    : MainMemory(name), spec_(spec), domain_(domain) {}

tlm::tlm_sync_enum FixedDram::nb_transport_fw(tlm::tlm_generic_payload& payload,
                                              tlm::tlm_phase& phase, sc_core::sc_time& delay) {
  if (phase != tlm::BEGIN_REQ) return tlm::TLM_ACCEPTED;
  const Cycles now = (sc_core::sc_time_stamp().value() + delay.value()) / domain_.period().value();
  const Bytes bytes = payload.get_data_length();
  const Cycles transfer = (bytes + spec_.bytes_per_cycle - 1) / spec_.bytes_per_cycle;
  const Cycles done = std::max(now + spec_.latency, bus_free_) + transfer;
  bus_free_ = done;
  stats_.bus_busy_cycles += transfer;
  if (payload.is_write()) {
    ++stats_.num_writes;
    stats_.bytes_written += bytes;
  } else {
    ++stats_.num_reads;
    stats_.bytes_read += bytes;
    stats_.sum_read_latency += done - now;
    stats_.max_read_latency = std::max(stats_.max_read_latency, done - now);
  }
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  delay += domain_.span(now, done);
  return tlm::TLM_COMPLETED;
}

}  // namespace sheaf
