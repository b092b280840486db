// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "channels/stepping_agent.h"
#include "channels/timed_channel.h"
#include "config/config.h"
#include "scene/scene.h"
#include "scene/tile_order.h"
#include "stats/counters.h"
#include "stats/stall_account.h"
#include "tracefile/memory_recorder.h"
#include "traversal/packet_pool.h"
#include "units/flow_control.h"
#include "units/ray_counts.h"

namespace sheaf {

#define SHEAF_PRIMARY_SOURCE_COUNTERS(X)            \
  X(num_packets, "packets", "Primary packets made") \
  X(num_rays, "rays", "Primary rays made")          \
  X(num_tiles, "tiles", "Tiles begun")
SHEAF_STATS(PrimarySourceStats, SHEAF_PRIMARY_SOURCE_COUNTERS);

/// Is told of the tiles as they begin.
class TileObserver {
 public:
  virtual ~TileObserver() = default;
  /// The first packet of this tile is admitted at cycle `now`.
  virtual void tile_begins(std::uint32_t tile, Cycles now) = 0;
};

/// Fills a packet with the camera rays of a run of pixels; returns the number of rays.
std::uint32_t make_primary_packet(const Camera& camera, const ImageSpec& image,
                                  const TileOrder::Run& run, RayPacket& packet);

/// Makes camera rays, tile by tile, in packets of neighbouring pixels, one packet an interval. With
/// tile flow control the next tile begins when all rays of the last one and all they spawned have
/// retired; with credits a packet is made when its worst case fits. `observer` may be null.
class PrimarySource final : public sc_core::sc_module, public SteppingAgent {
 public:
  PrimarySource(const sc_core::sc_module_name& name, const PrimarySourceSpec& spec,
                const ImageSpec& image, const TileOrder& order, const Camera& camera,
                PacketPool& packets, RayCounts& rays, FlowControl& flow, ClockDomain& domain,
                TileObserver* observer = nullptr);

  sc_core::sc_port<TimedOut<RayPacket*>> out_packets;

  [[nodiscard]] std::string stuck_reason() const override;

  /// Packets carry their cause; they reach a traversal unit `way` later at the earliest.
  void record_to(MemoryRecorder& recorder, Cycles way) {
    recorder_ = &recorder;
    way_ = way;
  }

  [[nodiscard]] const PrimarySourceStats& stats() const { return stats_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }
  /// Share of the tiles that have been begun, 0 to 1.
  [[nodiscard]] double progress() const {
    return static_cast<double>(order_.num_visited()) / order_.num_tiles();
  }

 private:
  void end_of_elaboration() override;
  Cycles act(Cycles now) override;
  bool prepare_packet(Cycles now);
  void explain(const AccessCause& cause, Cycles now);

  const PrimarySourceSpec spec_;
  const ImageSpec image_;
  TileOrder order_;
  const Camera& camera_;
  PacketPool& packets_;
  RayCounts& rays_;
  FlowControl& flow_;
  Inbox inbox_;
  RayPacket* packet_ = nullptr;    ///< made, not yet admitted or sent
  std::uint64_t reservation_ = 0;  ///< worst case of packet_
  Cycles next_packet_ = 0;
  bool tile_begun_ = false;
  TileObserver* const observer_;
  std::uint32_t num_admitted_ = 0;  ///< packets of the current tile
  PrimarySourceStats stats_;
  StallAccount stalls_;
  MemoryRecorder* recorder_ = nullptr;
  Cycles way_ = 0;
  AccessCause cause_;      ///< of the packets made at the moment
  Cycles unhindered_ = 0;  ///< when the next could leave if the link were never full
  bool had_no_credit_ = false;
};

}  // namespace sheaf
