// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Random traces: what is written is read, and more ways of an LRU cache never miss more often.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "generators.h"
#include "memory/cache_array.h"
#include "stats/stack_distance.h"
#include "tracefile/memory_block.h"

namespace sheaf::stability {
namespace {

MemoryLayout two_streams() {
  MemoryLayout layout;
  for (const char* name : {"unit0", "unit1"}) {
    layout.streams.push_back({.name = name,
                              .group = "unit",
                              .contexts = 64,
                              .caches = {{"node_cache", "node_cache"}, {"other", "other"}}});
  }
  layout.operations = {{.cache = 0, .kind = DataKind::kNode, .bytes = 8},
                       {.cache = 1, .kind = DataKind::kTriangle, .bytes = 40},
                       {.bytes = 0, .port_cycles = 7}};
  return layout;
}

/// Numbers of every size up to a power of two.
std::uint64_t any_below(int bits) {
  const int size = *rc::gen::inRange(0, bits + 1);
  return *rc::gen::arbitrary<std::uint64_t>() & ((std::uint64_t{1} << size) - 1);
}

MemoryBlock any_block(const MemoryLayout& layout) {
  MemoryBlock block;
  const int count = *rc::gen::inRange(0, 60);
  for (int i = 0; i < count; ++i) {
    MemoryRecord record;
    record.operation =
        static_cast<std::uint32_t>(*rc::gen::inRange<std::size_t>(0, layout.operations.size()));
    record.context = static_cast<std::uint8_t>(*rc::gen::inRange(0, 64));
    if (layout.operations[record.operation].bytes != 0) record.address = any_below(56);
    record.cycle = (i == 0 ? 0 : block.records.back().cycle) + any_below(40);
    record.begins = *rc::gen::arbitrary<bool>();
    record.ends = *rc::gen::arbitrary<bool>();
    if (record.begins) {
      ChainStart chain;
      chain.cause_stream = *rc::gen::element<std::uint16_t>(0, 1, AccessCause::kAllEarlier);
      chain.cause_record = any_below(48);
      chain.cause_ended = *rc::gen::arbitrary<bool>();
      chain.gap = any_below(51);
      chain.epoch = (block.chains.empty() ? 0 : block.chains.back().epoch) + any_below(40);
      block.chains.push_back(chain);
    }
    block.records.push_back(record);
  }
  return block;
}

auto fields(const MemoryRecord& r) {
  return std::tuple(r.address, r.cycle, r.operation, r.context, r.begins, r.ends, r.continues);
}
auto fields(const ChainStart& c) {
  return std::tuple(c.cause_stream, c.cause_record, c.cause_ended, c.gap, c.epoch);
}
template <typename T>
bool are_equal(const std::vector<T>& a, const std::vector<T>& b) {
  return std::ranges::equal(
      a, b, {}, [](const T& x) { return fields(x); }, [](const T& x) { return fields(x); });
}

RC_GTEST_PROP(TracesProperty, WhatIsWrittenIsRead, ()) {
  const MemoryLayout layout = two_streams();
  const MemoryBlock block = any_block(layout);
  const ByteVector raw = encode_memory_block(block, layout.operations);
  MemoryBlock read;
  decode_memory_block(raw, 1, static_cast<std::uint32_t>(block.records.size()), layout, read);
  RC_ASSERT(are_equal(read.records, block.records));
  RC_ASSERT(are_equal(read.chains, block.chains));
}

RC_GTEST_PROP(TracesProperty, LruMissesFallWithTheWaysAndAreThoseOfEachSizeSimulated, ()) {
  const auto lines =
      *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::inRange<std::uint64_t>(0, 40));
  const auto sets = *rc::gen::element<std::uint32_t>(1, 2, 8);
  StackDistances distances(sets);
  MissCurve curve;
  for (const std::uint64_t line : lines) curve.add(distances.access(line));
  std::uint64_t before = lines.size();
  for (std::uint32_t ways = 1; ways <= 41; ++ways) {
    CacheArray cache(sets, ways);
    std::uint64_t misses = 0;
    for (const std::uint64_t line : lines) {
      if (cache.touch(line)) continue;
      cache.fill(line, false);
      ++misses;
    }
    RC_ASSERT(misses == misses_at(curve.points(), ways));
    RC_ASSERT(misses <= before);
    before = misses;
  }
}

}  // namespace
}  // namespace sheaf::stability
