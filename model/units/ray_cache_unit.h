// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <systemc>
#include <vector>

#include "base/object_pool.h"
#include "channels/stepping_agent.h"
#include "channels/timed_channel.h"
#include "sorting/ray_sorter.h"
#include "sorting/spawn_bundle.h"
#include "stats/stall_account.h"
#include "tracefile/memory_recorder.h"
#include "units/flow_control.h"

namespace sheaf {

/// The ray cache: takes spawned rays in, bundle by bundle and rays_per_cycle at a time, and sends
/// the packets that leave to the FIFO. While the FIFO is full nothing is taken in. Sweeps its cells
/// when nothing else moves and the source has nothing to add.
class RayCacheUnit final : public sc_core::sc_module, public SteppingAgent {
 public:
  RayCacheUnit(const sc_core::sc_module_name& name, const RayCacheSpec& spec,
               std::unique_ptr<RaySorter> sorter, ObjectPool<SpawnBundle>& bundles,
               FlowControl& flow, ClockDomain& domain);

  sc_core::sc_port<TimedIn<SpawnBundle*>> in_bundles;
  sc_core::sc_port<TimedOut<RayPacket*>> out_packets;

  [[nodiscard]] std::string stuck_reason() const override;

  /// Packets that leave carry their cause; they reach a traversal unit `way` later at the earliest.
  void record_to(MemoryRecorder& recorder, Cycles way) {
    recorder_ = &recorder;
    way_ = way;
  }

  [[nodiscard]] const RaySorter& sorter() const { return *sorter_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }

 private:
  void end_of_elaboration() override;
  Cycles act(Cycles now) override;
  bool send_departures(Cycles now);
  bool insert_rays(Cycles now);
  bool time_out(Cycles now);
  bool sweep(Cycles now);
  void explain_departures(const AccessCause& cause, Cycles now);
  [[nodiscard]] Departure sweep_reason(Cycles now) const;
  [[nodiscard]] Cycles next_time_out() const;

  const RayCacheSpec spec_;
  std::unique_ptr<RaySorter> sorter_;
  ObjectPool<SpawnBundle>& bundles_;
  FlowControl& flow_;
  Inbox inbox_;
  SpawnBundle* bundle_ = nullptr;  ///< being taken in
  std::size_t position_ = 0;
  AccessCause arrived_;  ///< cause of the bundle taken in last
  std::vector<RayPacket*> departures_;
  std::size_t num_sent_ = 0;  ///< of departures_
  StallAccount stalls_;
  MemoryRecorder* recorder_ = nullptr;
  Cycles way_ = 0;
};

}  // namespace sheaf
