// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/memory_block.h"

#include <gtest/gtest.h>

#include "support/scratch_folder.h"
#include "tracefile/columns.h"
#include "tracefile/memory_recorder.h"
#include "tracefile/memory_stream.h"

namespace sheaf {
namespace {

MemoryLayout small_layout() {
  MemoryLayout layout;
  layout.streams = {
      {.name = "unit0", .group = "unit", .contexts = 4, .caches = {{"node_cache", "node_cache"}}},
      {.name = "unit1", .group = "unit", .contexts = 4, .caches = {{"node_cache", "node_cache"}}}};
  layout.operations = {{.kind = DataKind::kNode, .bytes = 8}, {.bytes = 0, .port_cycles = 7}};
  return layout;
}

MemoryBlock small_block() {
  MemoryBlock block;
  block.records = {{0x1000, 5, 0, 1, true, false, false},
                   {0, 5, 1, 0, true, true, false},
                   {0x40, 1'000'000'000, 0, 1, false, false, false},
                   {0xFFFF'FFFF'FFFF, 1'000'000'000, 0, 1, false, true, true}};
  block.chains = {{AccessCause::kAllEarlier, 0, false, 3, 0}, {1, 12345, true, 900, 7}};
  return block;
}

ByteVector encoded(const MemoryBlock& block, const MemoryLayout& layout) {
  return encode_memory_block(block, layout.operations);
}

void decode(const MemoryBlock& block, const MemoryLayout& layout, MemoryBlock& out) {
  decode_memory_block(encoded(block, layout), 0, static_cast<std::uint32_t>(block.records.size()),
                      layout, out);
}

TEST(MemoryBlock, GivesBackWhatWasWritten) {
  const MemoryBlock block = small_block();
  MemoryBlock read;
  decode(block, small_layout(), read);
  ASSERT_EQ(read.records.size(), block.records.size());
  for (std::size_t i = 0; i < block.records.size(); ++i) {
    EXPECT_EQ(read.records[i].address, block.records[i].address);
    EXPECT_EQ(read.records[i].cycle, block.records[i].cycle);
    EXPECT_EQ(read.records[i].operation, block.records[i].operation);
    EXPECT_EQ(read.records[i].context, block.records[i].context);
    EXPECT_EQ(read.records[i].begins, block.records[i].begins);
    EXPECT_EQ(read.records[i].ends, block.records[i].ends);
    EXPECT_EQ(read.records[i].continues, block.records[i].continues);
  }
  ASSERT_EQ(read.chains.size(), 2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.chains[i].cause_stream, block.chains[i].cause_stream);
    EXPECT_EQ(read.chains[i].cause_record, block.chains[i].cause_record);
    EXPECT_EQ(read.chains[i].cause_ended, block.chains[i].cause_ended);
    EXPECT_EQ(read.chains[i].gap, block.chains[i].gap);
    EXPECT_EQ(read.chains[i].epoch, block.chains[i].epoch);
  }
}

// Whatever bytes a crafted file brings, decoding ends with content that is in order, or refuses.
TEST(MemoryBlock, SurvivesEveryFlippedBitAndEveryTruncation) {
  const MemoryLayout layout = small_layout();
  const ByteVector raw = encoded(small_block(), layout);
  const auto try_decode = [&](const ByteVector& bytes) {
    MemoryBlock read;
    try {
      decode_memory_block(bytes, 0, 4, layout, read);
    } catch (const BadColumn&) {
      return;
    }
    for (const MemoryRecord& record : read.records) {
      ASSERT_LT(record.operation, layout.operations.size());
      ASSERT_LT(record.context, 4);
    }
  };
  for (std::size_t at = 0; at < raw.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      ByteVector damaged = raw;
      damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ (1 << bit));
      try_decode(damaged);
    }
    try_decode(ByteVector(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(at)));
  }
}

void expect_refused(const MemoryBlock& block, const MemoryLayout& layout, const char* why) {
  MemoryBlock read;
  try {
    decode(block, layout, read);
    FAIL() << why;
  } catch (const BadColumn& problem) {
    EXPECT_NE(std::string(problem.what()).find(why), std::string::npos) << problem.what();
  }
}

TEST(MemoryBlock, RefusesWhatTheLayoutDoesNotHave) {
  const MemoryLayout layout = small_layout();
  MemoryBlock block = small_block();
  block.records[0].context = 4;
  expect_refused(block, layout, "context");
  block = small_block();
  block.records[3].context = 2;
  expect_refused(block, layout, "continues");
  block = small_block();
  block.chains[1].cause_stream = 2;
  expect_refused(block, layout, "no stream");
  block = small_block();
  block.records[0].address = Address{1} << 60;
  expect_refused(block, layout, "address");
  MemoryLayout written = layout;
  written.operations[0].write = true;
  expect_refused(small_block(), written, "writes");
  MemoryLayout no_cache = layout;
  no_cache.streams[0].caches.clear();
  expect_refused(small_block(), no_cache, "cache");
}

/// Records a chain of `steps` in stream 0 and one that it causes in stream 1.
void record_two_chains(MemoryRecorder& recorder, std::size_t steps) {
  StreamRecorder& first = recorder.add_stream(small_layout().streams[0]);
  StreamRecorder& second = recorder.add_stream(small_layout().streams[1]);
  const auto node = [] { return MemoryOperation{.kind = DataKind::kNode, .bytes = 8}; };
  first.begin(2, recorder.begin_epoch(10), 14, 14);
  for (std::size_t i = 0; i < steps; ++i) {
    first.step(2, first.operation(0, node), 8 * i, i + 1 == steps, 20 + i);
  }
  const AccessCause cause = first.end(2, 20 + steps);
  second.begin(0, cause, 30 + steps, 30 + steps);
  second.step(0, second.operation(0, node), 64, true, 31 + steps);
  second.end(0, 40 + steps);
}

TEST(MemoryRecorder, WritesStreamsThatAreReadInOrderAcrossFrames) {
  const test::ScratchFolder scratch;
  constexpr std::size_t kSteps = 150'000;  // three frames
  MemoryLayout layout;
  {
    TraceWriter writer(scratch / "m.trace", {TraceKind::kMemory, {}, {}});
    MemoryRecorder recorder(writer);
    record_two_chains(recorder, kSteps);
    recorder.flush();
    layout = recorder.layout();
    writer.finish("{}");
  }
  TraceReader reader(scratch / "m.trace");
  EXPECT_EQ(layout.operations.size(), 1) << "the same operation of two units is one";
  MemoryStream first(reader, layout, 0);
  for (std::size_t i = 0; i < kSteps; ++i, first.pop()) {
    ASSERT_NE(first.peek(), nullptr);
    ASSERT_EQ(first.number(), i);
    ASSERT_EQ(first.peek()->address, 8 * i);
    ASSERT_EQ(first.peek()->cycle, 20 + i);
    ASSERT_EQ(first.peek()->begins, i == 0);
    ASSERT_EQ(first.peek()->ends, i + 1 == kSteps);
  }
  EXPECT_EQ(first.peek(), nullptr);
  MemoryStream second(reader, layout, 1);
  ASSERT_NE(second.peek(), nullptr);
  EXPECT_EQ(second.chain().cause_stream, 0);
  EXPECT_EQ(second.chain().cause_record, kSteps - 1);
  EXPECT_TRUE(second.chain().cause_ended);
  EXPECT_EQ(second.chain().gap, 10);

  MemoryAccesses all(reader, layout);
  Cycles last = 0;
  std::size_t count = 0;
  for (auto access = all.next(); access.record != nullptr; access = all.next(), ++count) {
    ASSERT_GE(access.record->cycle, last);
    last = access.record->cycle;
  }
  EXPECT_EQ(count, kSteps + 1);
}

TEST(MemoryRecorder, LeavesTheWaitForAContextOutOfTheGap) {
  const test::ScratchFolder scratch;
  TraceWriter writer(scratch / "m.trace", {TraceKind::kMemory, {}, {}});
  MemoryRecorder recorder(writer);
  MemoryTraceStream one = small_layout().streams[0];
  one.contexts = 1;
  StreamRecorder& unit = recorder.add_stream(one);
  const auto compute = [] { return MemoryOperation{}; };
  const AccessCause cause = recorder.all_earlier(0);
  unit.begin(0, cause, 5, 5);
  unit.step(0, unit.operation(0, compute), 0, true, 5);
  unit.end(0, 100);
  unit.begin(0, cause, 9, 101);  // could have come at 9, but the context was taken until 100
  unit.step(0, unit.operation(0, compute), 0, true, 101);
  unit.end(0, 110);
  unit.begin(0, cause, 9, 500);  // the context was free: something else held it up
  unit.step(0, unit.operation(0, compute), 0, true, 500);
  recorder.flush();
  writer.finish("{}");
  TraceReader reader(scratch / "m.trace");
  MemoryStream records(reader, recorder.layout(), 0);
  for (const Cycles gap : {5, 9, 500}) {
    ASSERT_NE(records.peek(), nullptr);
    EXPECT_EQ(records.chain().gap, gap);
    records.pop();
  }
}

}  // namespace
}  // namespace sheaf
