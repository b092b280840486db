// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/intersection_unit.h"

#include <fmt/format.h>

namespace sheaf {

IntersectionUnit::IntersectionUnit(const sc_core::sc_module_name& name, const UnitSpec& spec,
                                   int packet_size, const CacheSpec& cache,
                                   const TracedScene& scene, const AnswerTimes& times,
                                   ClockDomain& domain, TimedOut<LineRequest>& memory,
                                   std::uint16_t requester)
    : MultiContextUnit(name, spec, packet_size, domain),
      in_jobs("in_jobs"),
      in_lines("in_lines"),
      out_done("out_done"),
      scene_(scene),
      times_(times),
      cache_(cache, memory, requester),
      fetcher_(cache_),
      contexts_(spec.contexts) {}

void IntersectionUnit::end_of_elaboration() {
  jobs_.bind(in_jobs, inbox_);
  in_lines->set_consumer(inbox_);
  for (int i = 0; i < out_done.size(); ++i) out_done[i]->add_producer(inbox_);
  cache_.bind(inbox_);
}

void IntersectionUnit::start_of_simulation() {
  jobs_ahead_.bind(domain_, jobs_.producers(), inbox_.agent());
  lines_ahead_.bind(domain_, in_lines->producers(), inbox_.agent());
}

Cycles IntersectionUnit::accept_inputs(Cycles now) {
  while (in_lines->has_arrived(now)) {
    fetcher_.fill(in_lines->read(now), now, [&](int context) { unpark(context, now); });
  }
  LeafJob job;
  while (has_free_context() && jobs_.read(job, now)) {
    const int number = take_context();
    contexts_[static_cast<std::size_t>(number)] = {job, 0, Phase::kList};
    if (recorder_ != nullptr) record_begin(number, now);
    schedule(number, now);
    look_again();  // its credit may let the next one come
  }
  // Jobs that have arrived but find no context wait until ready() frees one.
  const Cycles next_job = has_free_context() ? jobs_.next_arrival() : kNever;
  return std::min(in_lines->next_arrival(), next_job);
}

// A job matters only while there is a context for it.
Cycles IntersectionUnit::earliest_input() {
  const Cycles job = has_free_context() ? jobs_ahead_.earliest() : kNever;
  return or_answer(job, parked(), lines_ahead_);
}

bool IntersectionUnit::ready(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  switch (context.phase) {
    case Phase::kList:
    case Phase::kTriangle:
      return true;
    case Phase::kTriangleIssued:
      ++context.tested;
      [[fallthrough]];
    case Phase::kListIssued:
      if (context.tested < context.job.num_tests) {
        context.phase = Phase::kTriangle;
        return true;
      }
      // The link has room for every context of the traversal unit.
      out_done[context.job.unit]->write_ahead({context.job.context}, now, context.job.context);
      if (recorder_ != nullptr) recorder_->end(number, now);
      free_context(number);
      look_again();
      inbox_.set_next(std::min(inbox_.next(), std::max(jobs_.next_arrival(), now + 1)));
      return false;
  }
  return false;
}

bool IntersectionUnit::fetch(int number, Address first, Bytes bytes, DataKind kind,
                             Cycles& port_cycles, Cycles now) {
  const std::uint64_t first_line = cache_.line_of(first);
  const auto num_lines =
      static_cast<std::uint32_t>(cache_.line_of(first + bytes - 1) - first_line + 1);
  const auto outcome = fetcher_.fetch(
      number, num_lines, kind, [&](std::uint32_t i) { return first_line + i; }, now);
  port_cycles = outcome.port_cycles;
  return outcome.complete;
}

void IntersectionUnit::issue(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  const std::uint32_t first = scene_.tree.nodes[context.job.leaf].first();
  Cycles port_cycles = 0;
  bool complete = false;
  if (recorder_ != nullptr && !fetcher_.has_begun(number)) record_step(number, now);
  if (context.phase == Phase::kList) {
    complete = fetch(number, scene_.memory.leaf_entry(first),
                     context.job.num_tests * MemoryMap::kLeafEntrySize, DataKind::kLeafList,
                     port_cycles, now);
    if (complete) context.phase = Phase::kListIssued;
  } else {
    const std::uint32_t triangle = scene_.tree.leaf_triangles[first + context.tested];
    complete = fetch(number, scene_.memory.triangle(triangle), MemoryMap::kTriangleSize,
                     DataKind::kTriangle, port_cycles, now);
    if (complete) context.phase = Phase::kTriangleIssued;
  }
  if (!complete) {
    park(number, now + times_.line);
    occupy_missed(port_cycles, now);
  } else if (context.phase == Phase::kListIssued) {
    occupy_fetch(number, cache_.hit_latency(), port_cycles, now);
  } else {
    occupy(number, slots_per_step_, cache_.hit_latency(), port_cycles, now);
  }
}

void IntersectionUnit::record_begin(int number, Cycles now) {
  const LeafJob& job = contexts_[static_cast<std::size_t>(number)].job;
  // Traversal units record to the streams of their own numbers.
  const AccessCause cause = recorder_->recorder().stream(job.unit).cause(job.context);
  recorder_->begin(number, cause, cause.sent + link_latency_, now);
}

void IntersectionUnit::record_step(int number, Cycles now) {
  const Context& context = contexts_[static_cast<std::size_t>(number)];
  const std::uint32_t first = scene_.tree.nodes[context.job.leaf].first();
  if (context.phase == Phase::kList) {
    const std::uint32_t count = context.job.num_tests;
    const std::uint32_t operation = recorder_->operation(count, [&] {
      return MemoryOperation{
          .kind = DataKind::kLeafList,
          .bytes = static_cast<std::uint32_t>(count * MemoryMap::kLeafEntrySize)};
    });
    recorder_->step(number, operation, scene_.memory.leaf_entry(first), false, now);
    return;
  }
  const std::uint32_t operation = recorder_->operation(0, [&] {
    return MemoryOperation{.kind = DataKind::kTriangle,
                           .bytes = MemoryMap::kTriangleSize,
                           .port_cycles = port_cycles(slots_per_step_),
                           .latency = step_latency()};
  });
  const std::uint32_t triangle = scene_.tree.leaf_triangles[first + context.tested];
  recorder_->step(number, operation, scene_.memory.triangle(triangle),
                  context.tested + 1 == context.job.num_tests, now);
}

std::string IntersectionUnit::stuck_reason() const {
  if (num_held() == 0) return {};
  return fmt::format("{}: {} jobs held, {} waiting for memory", name(), num_held(),
                     std::popcount(parked()));
}

}  // namespace sheaf
