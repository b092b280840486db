// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/primary_source.h"

#include <bit>

namespace sheaf::clocked {

PrimarySource::PrimarySource(std::string name, const PrimarySourceSpec& spec,
                             const ImageSpec& image, const TileOrder& order, const Camera& camera,
                             PacketPool& packets, RayCounts& rays, FlowControl& flow)
    : name_(std::move(name)),
      spec_(spec),
      image_(image),
      order_(order),
      camera_(camera),
      packets_(packets),
      rays_(rays),
      flow_(flow) {}

void PrimarySource::tick(Cycles now) {
  if (now >= next_packet_) stalls_.switch_to(act(now), now);
}

StallCause PrimarySource::act(Cycles now) {
  if (packet_ == nullptr && !prepare_packet(now)) {
    return order_.is_done() ? StallCause::kIdle : StallCause::kWaitingInput;
  }
  if (!flow_.admits(reservation_)) {
    flow_.set_source(FlowControl::Source::kNoCredit, now);
    return StallCause::kBlockedOutput;
  }
  flow_.set_source(FlowControl::Source::kIssuing, now);
  if (!out_packets->has_room(now)) return StallCause::kBlockedOutput;
  for (LaneMask left = packet_->active; left != 0; left &= left - 1) {
    rays_.spawn(packet_->tag[static_cast<std::size_t>(std::countr_zero(left))]);
  }
  const auto rays = static_cast<std::uint64_t>(std::popcount(packet_->active));
  ++stats_.num_packets;
  stats_.num_rays += rays;
  flow_.admit(rays, reservation_, now);
  out_packets->write(packet_, now);
  packet_ = nullptr;
  next_packet_ = now + spec_.interval;
  return StallCause::kBusy;
}

// False if the picture is done or the tile has to finish first.
bool PrimarySource::prepare_packet(Cycles now) {
  TileOrder::Run run;
  for (;;) {
    if (order_.is_done()) {
      flow_.set_source(FlowControl::Source::kExhausted, now);
      return false;
    }
    if (!tile_begun_) ++stats_.num_tiles;
    tile_begun_ = true;
    if (order_.next_run(run)) break;
    const bool last = order_.is_last();
    if (flow_.by_tile() && flow_.live() != 0 && !last) {
      flow_.set_source(FlowControl::Source::kTileIssued, now);
      return false;
    }
    order_.next_tile();
    tile_begun_ = false;
  }
  packet_ = packets_.acquire();
  make_primary_packet(camera_, image_, run, *packet_);
  reservation_ = 0;
  for (LaneMask left = packet_->active; left != 0; left &= left - 1) {
    reservation_ +=
        flow_.worst_case(packet_->tag[static_cast<std::size_t>(std::countr_zero(left))]);
  }
  return true;
}

}  // namespace sheaf::clocked
