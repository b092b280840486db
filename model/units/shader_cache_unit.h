// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>
#include <vector>

#include "channels/stepping_agent.h"
#include "channels/timed_channel.h"
#include "sorting/shading_sorter.h"
#include "stats/stall_account.h"
#include "tracefile/memory_recorder.h"
#include "units/flow_control.h"
#include "units/link_choice.h"

namespace sheaf {

/// The shader cache: takes traced packets in, rays_per_cycle at a time, and sends the packets that
/// leave its cells to the shader units in turn. While these are busy nothing is taken in. Sweeps
/// its cells when nothing else moves and the source has nothing to add, before the ray cache does.
class ShaderCacheUnit final : public sc_core::sc_module, public SteppingAgent {
 public:
  ShaderCacheUnit(const sc_core::sc_module_name& name, const ShaderCacheSpec& spec,
                  const Scene& scene, PacketPool& packets, FlowControl& flow, ClockDomain& domain);

  sc_core::sc_port<TimedIn<RayPacket*>, 0> in_packets;    ///< one per traversal unit
  sc_core::sc_port<TimedOut<RayPacket*>, 0> out_packets;  ///< one per shader unit

  [[nodiscard]] std::string stuck_reason() const override;

  /// Packets that leave carry their cause.
  void record_to(MemoryRecorder& recorder) { recorder_ = &recorder; }

  [[nodiscard]] const ShadingSorter& sorter() const { return sorter_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }

 private:
  void end_of_elaboration() override;
  Cycles act(Cycles now) override;
  bool send_departures(Cycles now);
  bool accept_packet(Cycles now);
  bool sweep(Cycles now);
  void explain_departures(const AccessCause& cause, Cycles now);

  const ShaderCacheSpec spec_;
  ShadingSorter sorter_;
  FlowControl& flow_;
  Inbox inbox_;
  MergedInput<RayPacket*> inputs_;
  RoundRobin<RayPacket*> outputs_;
  std::vector<RayPacket*> departures_;
  std::size_t num_sent_ = 0;  ///< of departures_
  Cycles busy_until_ = 0;     ///< taking a packet's rays in
  StallAccount stalls_;
  MemoryRecorder* recorder_ = nullptr;
};

}  // namespace sheaf
