// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/intersection_unit.h"

#include <algorithm>

namespace sheaf::clocked {

IntersectionUnit::IntersectionUnit(std::string name, const UnitSpec& spec,
                                   std::uint32_t packet_size, const TracedScene& scene, Cache cache)
    : ContextUnit(std::move(name), spec, packet_size),
      scene_(scene),
      cache_(std::move(cache)),
      jobs_(spec.contexts) {}

void IntersectionUnit::accept(Cycles now) {
  take_lines(cache_, now);
  while (has_free_context() && in_jobs.has_arrived(now))
    job(take_context(now)) = {in_jobs.read(now)};
}

void IntersectionUnit::resume(int context, Cycles now) {
  Job& j = job(context);
  if (j.issued) {
    if (j.has_list) ++j.tested;
    j.has_list = true;
    j.issued = false;
  }
  if (!j.has_list || j.tested != j.what.num_tests) return enqueue(context);
  out_done[j.what.unit]->write({j.what.context}, now);
  free(context);
}

void IntersectionUnit::issue(int context, Cycles now) {
  Job& j = job(context);
  const std::uint32_t first = scene_.tree.nodes[j.what.leaf].first();
  if (!j.has_list) {
    const Bytes bytes = j.what.num_tests * MemoryMap::kLeafEntrySize;
    if (!fetch_bytes(context, scene_.memory.leaf_entry(first), bytes, DataKind::kLeafList, now)) {
      return;
    }
    j.issued = true;
    return occupy(context, std::max<Cycles>(1, lookup_cycles()), cache_.hit_latency(), now);
  }
  const std::uint32_t triangle = scene_.tree.leaf_triangles[first + j.tested];
  const Address address = scene_.memory.triangle(triangle);
  if (!fetch_bytes(context, address, MemoryMap::kTriangleSize, DataKind::kTriangle, now)) return;
  j.issued = true;
  occupy(context, std::max(slots_per_step_ * spec_.initiation_interval, lookup_cycles()),
         cache_.hit_latency() + spec_.latency, now);
}

bool IntersectionUnit::fetch_bytes(int context, Address first, Bytes bytes, DataKind kind,
                                   Cycles now) {
  std::vector<std::uint64_t> lines;
  for (auto line = cache_.line_of(first); line <= cache_.line_of(first + bytes - 1); ++line) {
    lines.push_back(line);
  }
  return fetch(context, cache_, lines, kind, now);
}

}  // namespace sheaf::clocked
