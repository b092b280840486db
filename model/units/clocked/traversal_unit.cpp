// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/traversal_unit.h"

#include <bit>

namespace sheaf::clocked {

TraversalUnit::TraversalUnit(std::string name, const UnitSpec& spec, std::uint32_t packet_size,
                             const TracedScene& scene, HeatMaps& heat, std::uint16_t number,
                             Cache cache)
    : ContextUnit(std::move(name), spec, packet_size),
      scene_(scene),
      heat_(heat),
      number_(number),
      cache_(std::move(cache)),
      walks_(spec.contexts) {}

void TraversalUnit::accept(Cycles now) {
  take_lines(cache_, now);
  while (in_done->has_arrived(now)) {
    const int context = in_done->read(now).context;
    walk(context).phase = Phase::kAnswered;
    wait_until(context, now);
  }
  while (in_packets->has_arrived(now)) {
    RayPacket* packet = in_packets->read(now);
    trace(packet, walk(take_context(now)));
  }
}

void TraversalUnit::trace(RayPacket* packet, Walk& walk) {
  walk.packet = packet;
  walk.step = 0;
  walk.phase = Phase::kSetup;
  walk.issued = false;
  const auto lane = static_cast<std::size_t>(std::countr_zero(packet->active));
  const bool primary = packet->tag[lane].kind == RayKind::kPrimary;
  LaneCounts lanes;
  trace_packet(scene_.scheme, scene_.tree, scene_.triangles, *packet, &walk.log,
               heat_.wanted() ? &lanes : nullptr, primary ? primary_counts_ : secondary_counts_);
  if (heat_.wanted()) heat_.add(*packet, lanes);
}

void TraversalUnit::resume(int context, Cycles now) {
  Walk& w = walk(context);
  switch (w.phase) {
    case Phase::kSetup:
      if (!w.issued) return enqueue(context);
      return begin_step(context, now);
    case Phase::kStep:
      if (!w.issued) return enqueue(context);
      if (w.log[w.step].num_tests != 0) return send_job(context, now);
      ++w.step;
      return begin_step(context, now);
    case Phase::kJob:
      return send_job(context, now);
    case Phase::kAnswered:
      ++w.step;
      return begin_step(context, now);
    case Phase::kDone:
      return send_packet(context, now);
  }
}

void TraversalUnit::begin_step(int context, Cycles now) {
  Walk& w = walk(context);
  if (w.step == w.log.size()) return send_packet(context, now);
  w.phase = Phase::kStep;
  w.issued = false;
  enqueue(context);
}

void TraversalUnit::issue(int context, Cycles now) {
  Walk& w = walk(context);
  const Cycles interval = spec_.initiation_interval;
  if (w.phase == Phase::kSetup) {
    w.issued = true;
    occupy(context, slots_per_step_ * interval, spec_.latency, now);
    return;
  }
  const TraceStep& step = w.log[w.step];
  const std::uint64_t line = cache_.line_of(scene_.memory.node(step.node));
  if (!fetch(context, cache_, {line}, DataKind::kNode, now)) return;
  w.issued = true;
  occupy(context, step_slots(scene_.scheme, step, slots_per_step_) * interval,
         cache_.hit_latency() + spec_.latency, now);
}

void TraversalUnit::send_job(int context, Cycles now) {
  Walk& w = walk(context);
  w.phase = Phase::kJob;
  const TraceStep& step = w.log[w.step];
  const LeafJob job{step.node, step.num_tests, number_, static_cast<std::uint16_t>(context)};
  out_jobs.write(job, now) ? await(context) : block(context);
}

void TraversalUnit::send_packet(int context, Cycles now) {
  walk(context).phase = Phase::kDone;
  if (!out_packets.write(walk(context).packet, now)) return block(context);
  free(context);
  out_free->write({number_}, now);
}

}  // namespace sheaf::clocked
