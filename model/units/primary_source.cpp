// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/primary_source.h"

#include <fmt/format.h>

#include <bit>

#include "scene/camera.h"

namespace sheaf {

std::uint32_t make_primary_packet(const Camera& camera, const ImageSpec& image,
                                  const TileOrder::Run& run, RayPacket& packet) {
  for (int lane = 0; lane < packet.size; ++lane) {
    const std::uint32_t pixel = run.pixels[static_cast<std::size_t>(lane)];
    if (pixel == TileOrder::kNoPixel) continue;
    packet.put(lane, primary_ray(camera, image.width, image.height, pixel % image.width,
                                 pixel / image.width));
  }
  return static_cast<std::uint32_t>(std::popcount(packet.active));
}

PrimarySource::PrimarySource(const sc_core::sc_module_name& name, const PrimarySourceSpec& spec,
                             const ImageSpec& image, const TileOrder& order, const Camera& camera,
                             PacketPool& packets, RayCounts& rays, FlowControl& flow,
                             ClockDomain& domain, TileObserver* observer)
    : sc_module(name),
      SteppingAgent(domain),
      out_packets("out_packets"),
      spec_(spec),
      image_(image),
      order_(order),
      camera_(camera),
      packets_(packets),
      rays_(rays),
      flow_(flow),
      observer_(observer) {
  const std::size_t agent = domain.add(*this);
  inbox_.bind(domain, agent);
  flow.bind_source(inbox_);
  domain.schedule(agent, 0);
}

void PrimarySource::end_of_elaboration() {
  out_packets->add_producer(inbox_);
}

// Makes the next packet if there is one to be made now.
bool PrimarySource::prepare_packet(Cycles now) {
  TileOrder::Run run;
  while (packet_ == nullptr) {
    if (order_.is_done()) {
      flow_.set_source(FlowControl::Source::kExhausted, now);
      return false;
    }
    if (!tile_begun_) {
      tile_begun_ = true;
      ++stats_.num_tiles;
      if (recorder_ != nullptr && flow_.by_tile()) explain(recorder_->begin_epoch(now), now);
    }
    if (!order_.next_run(run)) {
      if (flow_.by_tile() && flow_.live(now) != 0 && !order_.is_last()) {
        flow_.set_source(FlowControl::Source::kTileIssued, now);
        return false;
      }
      order_.next_tile();
      tile_begun_ = false;
      num_admitted_ = 0;
      continue;
    }
    packet_ = packets_.acquire();
    make_primary_packet(camera_, image_, run, *packet_);
    reservation_ = 0;
    for (LaneMask left = packet_->active; left != 0; left &= left - 1) {
      reservation_ +=
          flow_.worst_case(packet_->tag[static_cast<std::size_t>(std::countr_zero(left))]);
    }
  }
  return true;
}

// What makes the next packets possible, from this cycle on.
void PrimarySource::explain(const AccessCause& cause, Cycles now) {
  cause_ = cause;
  unhindered_ = now;
}

Cycles PrimarySource::act(Cycles now) {
  if (now < next_packet_) return next_packet_;
  if (!prepare_packet(now)) {
    stalls_.switch_to(flow_.source() == FlowControl::Source::kExhausted ? StallCause::kIdle
                                                                        : StallCause::kWaitingInput,
                      now);
    return flow_.next_notice(now);  // woken when the tile has finished
  }
  if (!flow_.admits(reservation_, now)) {
    flow_.set_source(FlowControl::Source::kNoCredit, now);
    had_no_credit_ = true;
    stalls_.switch_to(StallCause::kBlockedOutput, now);
    return flow_.next_notice(now);  // woken when rays have retired
  }
  flow_.set_source(FlowControl::Source::kIssuing, now);
  if (recorder_ != nullptr && had_no_credit_) explain(recorder_->last_retired(), now);
  had_no_credit_ = false;
  if (out_packets->num_free(now) == 0) {
    out_packets->notify_when_free(inbox_);
    stalls_.switch_to(StallCause::kBlockedOutput, now);
    return kNever;
  }
  const auto rays = static_cast<std::uint64_t>(std::popcount(packet_->active));
  for (LaneMask left = packet_->active; left != 0; left &= left - 1) {
    rays_.spawn(packet_->tag[static_cast<std::size_t>(std::countr_zero(left))]);
  }
  if (num_admitted_++ == 0 && observer_ != nullptr) observer_->tile_begins(order_.tile(), now);
  ++stats_.num_packets;
  stats_.num_rays += rays;
  flow_.admit(rays, reservation_, now);
  packet_->cause = cause_;
  packet_->cause.sent = unhindered_ + way_;
  unhindered_ += spec_.interval;
  out_packets->nb_write(packet_, now);
  packet_ = nullptr;
  next_packet_ = now + spec_.interval;
  stalls_.switch_to(StallCause::kBusy, now);
  return next_packet_;
}

std::string PrimarySource::stuck_reason() const {
  if (order_.is_done() && packet_ == nullptr) return {};
  const char* why = "the tile has not finished";
  if (flow_.source() == FlowControl::Source::kNoCredit) why = "no credit for the next packet";
  if (flow_.source() == FlowControl::Source::kIssuing) why = "its link to the arbiter is full";
  return fmt::format("{}: {} of {} tiles begun, {}", name(), order_.num_visited(),
                     order_.num_tiles(), why);
}

}  // namespace sheaf
