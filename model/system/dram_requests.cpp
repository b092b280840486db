// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/dram_requests.h"

#include <array>
#include <string_view>
#include <utility>

#include "base/errors.h"

namespace sheaf {
namespace {

std::uint32_t num_sets(CacheMode mode, Bytes capacity, Bytes line, std::uint64_t ways) {
  return mode == CacheMode::kNormal ? static_cast<std::uint32_t>(capacity / (line * ways)) : 0;
}

}  // namespace

const CacheSpec* find_cache(const Config& config, std::string_view group) {
  const std::array<std::pair<std::string_view, const CacheSpec*>, 5> known{
      {{"node_cache", &config.node_cache},
       {"triangle_cache", &config.triangle_cache},
       {"attribute_cache", &config.attribute_cache},
       {"texture_cache", &config.texture_cache},
       {"film_cache", &config.film_cache}}};
  for (const auto& [name, spec] : known) {
    if (name == group) return spec;
  }
  return nullptr;
}

DramRequests::DramRequests(const Config& config, const MemoryLayout& layout, Sink sink)
    : sink_(std::move(sink)),
      shared_{
          config.l2.mode, config.l2.line,
          CacheArray(num_sets(config.l2.mode, config.l2.capacity, config.l2.line, config.l2.ways),
                     config.l2.ways)} {
  for (const MemoryTraceStream& stream : layout.streams) {
    auto& caches = private_.emplace_back();
    for (const MemoryTraceCache& cache : stream.caches) {
      const CacheSpec* spec = find_cache(config, cache.group);
      if (spec == nullptr) {
        throw Error(ExitCode::kTrace, "the trace names a cache that there is not");
      }
      caches.push_back(
          {spec->mode, spec->line,
           CacheArray(num_sets(spec->mode, spec->capacity, spec->line, spec->ways), spec->ways)});
    }
  }
}

void DramRequests::add(const MemoryAccesses::Access& access) {
  Level& cache = private_[access.stream][access.operation->cache];
  cycle_ = access.record->cycle;
  const Address first = access.record->address / cache.line;
  const Address last = (access.record->address + access.operation->bytes - 1) / cache.line;
  for (Address line = first; line <= last; ++line) {
    access_private(cache, line, access.operation->write);
  }
}

void DramRequests::access_private(Level& cache, std::uint64_t line, bool write) {
  if (cache.mode == CacheMode::kPerfect) return;
  if (cache.array.touch(line)) {
    if (write) cache.array.mark_dirty(line);
    return;
  }
  access_shared(line * cache.line, cache.line, false);
  const CacheArray::Victim victim = cache.array.fill(line, write);
  if (victim.valid && victim.dirty) access_shared(victim.line * cache.line, cache.line, true);
}

// A write that misses goes on and takes no place.
void DramRequests::access_shared(Address address, Bytes bytes, bool write) {
  if (shared_.mode == CacheMode::kPerfect) return;
  const std::uint64_t line = address / shared_.line;
  if (shared_.array.touch(line)) {
    if (write) shared_.array.mark_dirty(line);
    return;
  }
  if (write) return send(address, bytes, true);
  send(line * shared_.line, shared_.line, false);
  const CacheArray::Victim victim = shared_.array.fill(line, false);
  if (victim.valid && victim.dirty) send(victim.line * shared_.line, shared_.line, true);
}

void DramRequests::finish() {
  for (auto& caches : private_) {
    for (Level& cache : caches) {
      cache.array.clean_all(
          [&](std::uint64_t line) { access_shared(line * cache.line, cache.line, true); });
    }
  }
}

}  // namespace sheaf
