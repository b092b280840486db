// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/intersection_unit.h"

#include <fmt/format.h>

namespace sheaf {

IntersectionUnit::IntersectionUnit(const sc_core::sc_module_name& name, const UnitSpec& spec,
                                   int packet_size, const CacheSpec& cache,
                                   const TracedScene& scene, ClockDomain& domain,
                                   TimedOut<LineRequest>& memory, std::uint16_t requester)
    : MultiContextUnit(name, spec, packet_size, domain),
      in_jobs("in_jobs"),
      in_lines("in_lines"),
      out_done("out_done"),
      scene_(scene),
      cache_(cache, memory, requester),
      fetcher_(cache_),
      contexts_(spec.contexts) {}

void IntersectionUnit::end_of_elaboration() {
  in_jobs->set_consumer(inbox_);
  in_lines->set_consumer(inbox_);
}

Cycles IntersectionUnit::accept_inputs(Cycles now) {
  while (in_lines->has_arrived(now)) {
    fetcher_.fill(in_lines->read(now), now, [&](int context) { unpark(context, now); });
  }
  while (has_free_context() && in_jobs->has_arrived(now)) {
    const int number = take_context();
    contexts_[static_cast<std::size_t>(number)] = {in_jobs->read(now), 0, Phase::kList};
    schedule(number, now);
  }
  // Jobs that have arrived but find no context wait until ready() frees one.
  const Cycles next_job = has_free_context() ? in_jobs->next_arrival() : kNever;
  return std::min(in_lines->next_arrival(), next_job);
}

void IntersectionUnit::ready(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  switch (context.phase) {
    case Phase::kList:
    case Phase::kTriangle: enqueue(number); return;
    case Phase::kTriangleIssued: ++context.tested; [[fallthrough]];
    case Phase::kListIssued:
      if (context.tested < context.job.num_tests) {
        context.phase = Phase::kTriangle;
        enqueue(number);
        return;
      }
      // The link has room for every context of the traversal unit.
      out_done[context.job.unit]->nb_write({context.job.context}, now);
      free_context(number);
      inbox_.set_next(std::min(inbox_.next(), std::max(in_jobs->next_arrival(), now + 1)));
      return;
  }
}

bool IntersectionUnit::fetch(int number, Address first, Bytes bytes, DataKind kind,
                             std::uint32_t& lookups, Cycles now) {
  const std::uint64_t first_line = cache_.line_of(first);
  const auto num_lines =
      static_cast<std::uint32_t>(cache_.line_of(first + bytes - 1) - first_line + 1);
  const auto outcome = fetcher_.fetch(
      number, num_lines, kind, [&](std::uint32_t i) { return first_line + i; }, now);
  lookups = outcome.lookups;
  return outcome.complete;
}

void IntersectionUnit::issue(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  const std::uint32_t first = scene_.tree.nodes[context.job.leaf].first();
  std::uint32_t lookups = 0;
  bool complete = false;
  Cycles slots = 1;
  if (context.phase == Phase::kList) {
    complete = fetch(number, scene_.memory.leaf_entry(first),
                     context.job.num_tests * MemoryMap::kLeafEntrySize, DataKind::kLeafList,
                     lookups, now);
    if (complete) context.phase = Phase::kListIssued;
  } else {
    const std::uint32_t triangle = scene_.tree.leaf_triangles[first + context.tested];
    complete = fetch(number, scene_.memory.triangle(triangle), MemoryMap::kTriangleSize,
                     DataKind::kTriangle, lookups, now);
    slots = slots_per_step_;
    if (complete) context.phase = Phase::kTriangleIssued;
  }
  if (complete) {
    occupy(number, slots, cache_.hit_latency(), lookups, now);
  } else {
    park(number);
    occupy_missed(lookups, now);
  }
}

std::string IntersectionUnit::stuck_reason() const {
  if (num_held() == 0) return {};
  return fmt::format("{}: {} jobs held, {} waiting for memory", name(), num_held(),
                     std::popcount(parked()));
}

}  // namespace sheaf
