// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "channels/clock_domain.h"
#include "config/config.h"
#include "memory/main_memory.h"

namespace sheaf {

/// DRAM of fixed latency and bandwidth behind a TLM-2.0 socket: data starts to flow `latency` after
/// the request, or when the bus is free, and occupies the bus for bytes / bytes_per_cycle, rounded
/// up. Requests are taken in the order of the calls. Answers at once with TLM_COMPLETED and the
/// response's time as the annotated delay, so it needs no SystemC process.
/// Throws Error(kUsage) if that time lies beyond what SystemC can say.
class FixedDram final : public MainMemory {
 public:
  FixedDram(const sc_core::sc_module_name& name, const DramSpec& spec, const ClockDomain& domain);

  [[nodiscard]] DramStats stats(Cycles /*end*/) const override { return stats_; }
  void report_details(const std::string& /*path*/, Cycles /*end*/,
                      StatsTree& /*stats*/) const override {}

 private:
  tlm::tlm_sync_enum nb_transport_fw(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                     sc_core::sc_time& delay) override;

  const DramSpec spec_;
  const ClockDomain& domain_;
  Cycles bus_free_ = 0;
  DramStats stats_;
};

}  // namespace sheaf
