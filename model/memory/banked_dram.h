// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "channels/clock_domain.h"
#include "config/dram/device.h"
#include "memory/dram/clock_ratio.h"
#include "memory/dram/dram_system.h"
#include "memory/main_memory.h"

namespace sheaf {

/// Channels, banks and rows behind the L2's TLM-2.0 socket. A request is taken at once (END_REQ)
/// and answered on the backward path with the time of its last byte; while queues are full,
/// requests wait before them, in order.
///
/// The memory has a clock of its own. A request is seen at the first tick of it that is not before
/// its arrival, and its data at the first core cycle that is not before their last byte.
///
/// An agent of the core's clock domain: it acts at the last core cycle before the earliest data
/// that a command could bring, and then issues all commands up to there at once.
class BankedDram final : public MainMemory, public Agent {
 public:
  /// `core_hz`: frequency of the domain's clock.
  BankedDram(const sc_core::sc_module_name& name, const DramDevice& device, double core_hz,
             ClockDomain& domain);

  [[nodiscard]] std::size_t agent() const { return inbox_.agent(); }
  Cycles wake(Cycles now) override;
  [[nodiscard]] std::string stuck_reason() const override;

  [[nodiscard]] const DramDevice& device() const { return memory_.device(); }
  /// Every command that a channel issues, in order; seen later than it happens.
  void watch(std::size_t channel, std::function<void(const IssuedCommand&)> watcher) {
    memory_.channel(channel).watch(std::move(watcher));
  }
  /// The core cycle of a cycle of the memory.
  [[nodiscard]] Cycles to_core(Cycles memory_cycle) const { return to_core_.up(memory_cycle); }

  [[nodiscard]] DramStats stats(Cycles end) const override;
  void report_details(const std::string& path, Cycles end, StatsTree& stats) const override;

 private:
  tlm::tlm_sync_enum nb_transport_fw(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                     sc_core::sc_time& delay) override;
  void answer(const DramSystem::Done& done);
  [[nodiscard]] Cycles next_wake() const;
  /// The memory's time that all commands issued so far lie before, and the length of the run.
  [[nodiscard]] Cycles memory_end(Cycles end) const;

  DramSystem memory_;
  const ClockRatio to_memory_, to_core_;
  const Cycles shortest_latency_;  ///< tCK, from a column command to its last byte
  ClockDomain& domain_;
  Inbox inbox_;
  Cycles advanced_to_ = 0;  ///< tCK, exclusive
  DramStats stats_;
};

}  // namespace sheaf
