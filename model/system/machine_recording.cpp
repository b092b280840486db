// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "system/machine.h"

namespace sheaf {
namespace {

MemoryTraceStream stream_of(const char* group, std::size_t i, const UnitSpec& unit,
                            Cycles turnaround) {
  return {.name = fmt::format("{}{}", group, i),
          .group = group,
          .contexts = unit.contexts,
          .turnaround = turnaround,
          .retry_interval = unit.initiation_interval};
}

}  // namespace

// Streams in the order in which their caches are numbered at the L2, traversal units first: a job
// names its traversal unit by number.
void Machine::record_memory(MemoryRecorder& recorder) {
  const Cycles link = config_.link.latency;
  recorder.set_answer_latency(link);
  for (std::size_t i = 0; i < traversal_units_.size(); ++i) {
    // The arbiter learns of a free context over one link and fills it over another.
    auto stream = stream_of("traversal_unit", i, config_.traversal_unit, 2 * link);
    stream.caches = {{"node_cache", "node_cache"}};
    traversal_units_[i]->record_to(recorder.add_stream(stream));
  }
  for (std::size_t i = 0; i < intersection_units_.size(); ++i) {
    auto stream = stream_of("intersection_unit", i, config_.intersection_unit, 1);
    stream.caches = {{"triangle_cache", "triangle_cache"}};
    intersection_units_[i]->record_to(recorder.add_stream(stream), link);
  }
  for (std::size_t i = 0; i < shader_units_.size(); ++i) {
    auto stream = stream_of("shader_unit", i, config_.shader_unit, 1);
    stream.caches = {{"attribute_cache", "attribute_cache"}};
    if (plan_.texture_cache) stream.caches.push_back({"texture_cache", "texture_cache"});
    shader_units_[i]->record_to(recorder.add_stream(stream), link);
  }
  const MemoryTraceStream film{
      .name = "film", .group = "film", .awaited = false, .caches = {{"cache", "film_cache"}}};
  film_->record_to(recorder.add_stream(film), link);
  primary_source_->record_to(recorder, 2 * link);
  const Cycles way = config_.packet_fifo.latency + link;
  if (ray_cache_) ray_cache_->record_to(recorder, config_.ray_cache.latency + way);
  if (spawn_router_) spawn_router_->record_way(way);
  if (shader_cache_) shader_cache_->record_to(recorder);
}

}  // namespace sheaf
