// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/traversal_unit.h"

#include <fmt/format.h>

namespace sheaf {

void HeatMaps::add(const RayPacket& packet, const LaneCounts& lanes) {
  for (LaneMask left = packet.active; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    const std::uint32_t pixel = packet.tag[i].pixel;
    if (!rays.empty()) ++rays[pixel];
    if (!node_visits.empty()) node_visits[pixel] += lanes.inner_visits[i];
    if (!triangle_tests.empty()) triangle_tests[pixel] += lanes.triangle_tests[i];
  }
}

TraversalUnit::TraversalUnit(const sc_core::sc_module_name& name, const UnitSpec& spec,
                             int packet_size, const CacheSpec& cache, const TracedScene& scene,
                             const AnswerTimes& times, HeatMaps* heat, ClockDomain& domain,
                             std::uint16_t number, TimedOut<LineRequest>& memory,
                             std::uint16_t requester)
    : MultiContextUnit(name, spec, packet_size, domain),
      in_packets("in_packets"),
      in_done("in_done"),
      in_lines("in_lines"),
      out_jobs("out_jobs"),
      out_packets("out_packets"),
      out_free("out_free"),
      scene_(scene),
      times_(times),
      heat_(heat),
      number_(number),
      cache_(cache, memory, requester),
      fetcher_(cache_),
      contexts_(spec.contexts) {}

void TraversalUnit::end_of_elaboration() {
  in_packets->set_consumer(inbox_);
  in_done->set_consumer(inbox_);
  in_lines->set_consumer(inbox_);
  jobs_.bind(out_jobs, inbox_);
  packets_.bind(out_packets, inbox_);
  out_free->add_producer(inbox_);
  cache_.bind(inbox_);
}

void TraversalUnit::start_of_simulation() {
  packets_ahead_.bind(domain_, in_packets->producers(), inbox_.agent());
  answers_ahead_.bind(domain_, in_done->producers(), inbox_.agent());
  lines_ahead_.bind(domain_, in_lines->producers(), inbox_.agent());
}

Cycles TraversalUnit::accept_inputs(Cycles now) {
  while (in_lines->has_arrived(now)) {
    fetcher_.fill(in_lines->read(now), now, [&](int context) { unpark(context, now); });
  }
  while (in_done->has_arrived(now)) {
    const int context = in_done->read(now).context;
    contexts_[static_cast<std::size_t>(context)].phase = Phase::kAnswered;
    answered(context);
    schedule(context, now);
  }
  // The arbiter sends a packet only for a context that it knows to be free.
  while (in_packets->has_arrived(now)) accept_packet(in_packets->read(now), now);
  return std::min({in_lines->next_arrival(), in_done->next_arrival(), in_packets->next_arrival()});
}

// Packets come only for a free context; lines and answers only for who has asked for them.
Cycles TraversalUnit::earliest_input() {
  const Cycles packet = has_free_context() ? packets_ahead_.earliest() : kNever;
  return or_answer(or_answer(packet, awaiting(), answers_ahead_), parked(), lines_ahead_);
}

void TraversalUnit::accept_packet(RayPacket* packet, Cycles now) {
  const int number = take_context();
  Context& context = contexts_[static_cast<std::size_t>(number)];
  context.packet = packet;
  context.phase = Phase::kSetup;
  const auto lane = static_cast<std::size_t>(std::countr_zero(packet->active));
  const bool primary = packet->tag[lane].kind == RayKind::kPrimary;
  TraceCounts& counts = primary ? primary_counts_ : secondary_counts_;
  const bool per_lane = heat_ != nullptr && heat_->wanted();
  LaneCounts lanes;
  trace_packet(scene_.scheme, scene_.tree, scene_.triangles, *packet, &context.log,
               per_lane ? &lanes : nullptr, counts);
  if (per_lane) heat_->add(*packet, lanes);
  if (recorder_ != nullptr) recorder_->begin(number, packet->cause, packet->cause.sent, now);
  context.step = context.log.data();
  context.end = context.step + context.log.size();
  schedule(number, now);
}

bool TraversalUnit::ready(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  switch (context.phase) {
    case Phase::kStepIssued:
      if (context.step->num_tests != 0) {
        context.phase = Phase::kJob;
        send_job(number, now);
        return false;
      }
      [[fallthrough]];
    case Phase::kAnswered:
      ++context.step;
      [[fallthrough]];
    case Phase::kSetupIssued:
      return begin_step(number, now);
    case Phase::kSetup:
    case Phase::kStep:
      return true;
    case Phase::kJob:
      send_job(number, now);
      return false;
    case Phase::kDone:
      send_packet(number, now);
      return false;
  }
  return false;
}

bool TraversalUnit::begin_step(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  if (context.step != context.end) {
    context.phase = Phase::kStep;
    return true;
  }
  context.phase = Phase::kDone;
  send_packet(number, now);
  return false;
}

void TraversalUnit::issue(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  if (context.phase == Phase::kSetup) {
    context.phase = Phase::kSetupIssued;
    if (recorder_ != nullptr) {
      const std::uint32_t operation = recorder_->operation(0, [&] {
        return MemoryOperation{.port_cycles = port_cycles(slots_per_step_),
                               .latency = step_latency()};
      });
      recorder_->step(number, operation, 0, context.step == context.end, now);
    }
    occupy(number, slots_per_step_, 0, 0, now);
    return;
  }
  if (recorder_ != nullptr && !fetcher_.has_begun(number)) record_step(number, now);
  const std::uint64_t line = cache_.line_of(scene_.memory.node(context.step->node));
  if (fetcher_.fetch_one(number, line, DataKind::kNode, now)) {
    context.phase = Phase::kStepIssued;
    const std::uint32_t slots = step_slots(scene_.scheme, *context.step, slots_per_step_);
    occupy(number, slots, cache_.hit_latency(), 0, now);
  } else {
    park(number, now + times_.line);
    occupy_missed(0, now);
  }
}

void TraversalUnit::send_job(int number, Cycles now) {
  const TraceStep& step = *contexts_[static_cast<std::size_t>(number)].step;
  const LeafJob job{step.node, step.num_tests, number_, static_cast<std::uint16_t>(number)};
  switch (jobs_.write(job, now, is_certain(now), inbox_)) {
    case Sent::kYes:
      unblock(number);
      look_again();
      await(number, now + times_.leaf_fixed + step.num_tests * times_.leaf_test);
      if (recorder_ != nullptr) recorder_->set_out(number, now);
      return;
    case Sent::kNo:
      block(number);
      return;
    case Sent::kUnknown:
      hold_back(number, now);
      return;
  }
}

void TraversalUnit::send_packet(int number, Cycles now) {
  RayPacket* packet = contexts_[static_cast<std::size_t>(number)].packet;
  switch (packets_.write(packet, now, is_certain(now), inbox_)) {
    case Sent::kYes:
      unblock(number);
      look_again();
      free_context(number);
      out_free->write_ahead({number_}, now, number_);
      if (recorder_ != nullptr) {
        packet->cause = recorder_->end(number, now);
      }
      return;
    case Sent::kNo:
      block(number);
      return;
    case Sent::kUnknown:
      hold_back(number, now);
      return;
  }
}

void TraversalUnit::record_step(int number, Cycles now) {
  const Context& context = contexts_[static_cast<std::size_t>(number)];
  const TraceStep& step = *context.step;
  const std::uint32_t slots = step_slots(scene_.scheme, step, slots_per_step_);
  const bool calls = step.num_tests != 0;
  const std::uint32_t operation = recorder_->operation(2 * slots + (calls ? 1 : 0), [&] {
    return MemoryOperation{.kind = DataKind::kNode,
                           .bytes = MemoryMap::kNodeSize,
                           .calls = calls,
                           .port_cycles = port_cycles(slots),
                           .latency = step_latency()};
  });
  recorder_->step(number, operation, scene_.memory.node(step.node), context.step + 1 == context.end,
                  now);
}

std::string TraversalUnit::stuck_reason() const {
  if (num_held() == 0) return {};
  return fmt::format("{}: {} packets held, {} waiting for memory, {} blocked by a full link",
                     name(), num_held(), std::popcount(parked()), std::popcount(blocked()));
}

}  // namespace sheaf
