// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/scene.h"
#include "scene/tile_order.h"
#include "stats/stall_account.h"
#include "traversal/packet_pool.h"
#include "units/clocked/link.h"
#include "units/flow_control.h"
#include "units/primary_source.h"
#include "units/ray_counts.h"

namespace sheaf::clocked {

/// Makes camera rays, tile by tile, one packet an interval, as flow control lets it.
class PrimarySource {
 public:
  PrimarySource(std::string name, const PrimarySourceSpec& spec, const ImageSpec& image,
                const TileOrder& order, const Camera& camera, PacketPool& packets, RayCounts& rays,
                FlowControl& flow);

  Link<RayPacket*>* out_packets = nullptr;

  void tick(Cycles now);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const PrimarySourceStats& stats() const { return stats_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }
  /// Share of the tiles that have been begun, 0 to 1.
  [[nodiscard]] double progress() const {
    return static_cast<double>(order_.num_visited()) / order_.num_tiles();
  }

 private:
  [[nodiscard]] StallCause act(Cycles now);
  bool prepare_packet(Cycles now);

  const std::string name_;
  const PrimarySourceSpec spec_;
  const ImageSpec image_;
  TileOrder order_;
  const Camera& camera_;
  PacketPool& packets_;
  RayCounts& rays_;
  FlowControl& flow_;
  RayPacket* packet_ = nullptr;    ///< made, not yet admitted or sent
  std::uint64_t reservation_ = 0;  ///< worst case of packet_
  Cycles next_packet_ = 0;
  bool tile_begun_ = false;
  PrimarySourceStats stats_;
  StallAccount stalls_;
};

}  // namespace sheaf::clocked
