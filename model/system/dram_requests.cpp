// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/dram_requests.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/errors.h"

namespace sheaf {
namespace {

using Cache = TagHierarchy::Cache;

struct Known {
  std::string_view group;
  Cache cache;
  std::size_t units;
};

std::array<Known, TagHierarchy::kNumCaches> known_caches(const Config& config) {
  return {{{"node_cache", Cache::kNode, config.traversal_unit.count},
           {"triangle_cache", Cache::kTriangle, config.intersection_unit.count},
           {"attribute_cache", Cache::kAttribute, config.shader_unit.count},
           {"texture_cache", Cache::kTexture, config.shader_unit.count},
           {"film_cache", Cache::kFilm, 1}}};
}

}  // namespace

DramRequests::DramRequests(const Config& config, const MemoryLayout& layout, Sink sink)
    : tags_(config) {
  tags_.set_dram_sink([this, sink = std::move(sink)](Address address, Bytes bytes, bool write) {
    sink({address, cycle_, bytes, write});
  });
  std::array<std::size_t, TagHierarchy::kNumCaches> used{};
  const auto known = known_caches(config);
  for (const MemoryTraceStream& stream : layout.streams) {
    auto& caches = caches_.emplace_back();
    for (const MemoryTraceCache& cache : stream.caches) {
      const auto found = std::ranges::find(known, cache.group, &Known::group);
      if (found == known.end()) {
        throw Error(ExitCode::kTrace, "the trace names a cache that there is not");
      }
      const std::size_t unit = used[static_cast<std::size_t>(found->cache)]++;
      if (unit == found->units) {
        throw Error(ExitCode::kTrace,
                    "the trace has more units than the configuration that it was recorded under");
      }
      caches.push_back({found->cache, unit});
    }
  }
}

void DramRequests::add(const MemoryAccesses::Access& access) {
  const auto& [cache, unit] = caches_[access.stream][access.operation->cache];
  const bool write = access.operation->write;
  if (write && cache != Cache::kFilm) {
    throw Error(ExitCode::kTrace, "the trace writes to a cache that is only read");
  }
  cycle_ = access.record->cycle;
  const Address begin = access.record->address;
  const Address end = begin + access.operation->bytes;
  const std::uint64_t last = tags_.line_of(cache, end - 1);
  for (std::uint64_t line = tags_.line_of(cache, begin); line <= last; ++line) {
    if (write) {
      tags_.modify_film(line, access.operation->bytes);
    } else {
      tags_.read(cache, unit, line);
    }
  }
}

void DramRequests::finish() {
  tags_.flush();
}

}  // namespace sheaf
