// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/memory_block.h"

#include <utility>

namespace sheaf {
namespace {

// A record's code: the operation's number times eight, and these.
constexpr std::uint64_t kBeginsFlag = 1;
constexpr std::uint64_t kContinuesFlag = 2;
constexpr std::uint64_t kEndsFlag = 4;
constexpr unsigned kFlagBits = 3;
// Far above any machine's memory and any run, and safe to add to.
constexpr Address kMaxAddress = Address{1} << 56;
constexpr Cycles kMaxCycle = Cycles{1} << 51;

}  // namespace

void MemoryBlockWriter::add(std::span<const MemoryRecord> records,
                            const std::vector<MemoryOperation>& operations) {
  const std::size_t count = records.size();
  // Contexts are less than 128, so that these numbers are single bytes.
  contexts_.put_all(count, [&](std::size_t i) { return std::uint64_t{records[i].context}; });
  Cycles before = last_cycle_;
  cycles_.put_all(count, [&](std::size_t i) {
    return records[i].cycle - std::exchange(before, records[i].cycle);
  });
  last_cycle_ = before;
  codes_.put_all(count, [&](std::size_t i) {
    const MemoryRecord& record = records[i];
    return std::uint64_t{record.operation} << kFlagBits | (record.begins ? kBeginsFlag : 0) |
           (record.continues ? kContinuesFlag : 0) | (record.ends ? kEndsFlag : 0);
  });
  steps_.clear();
  for (const MemoryRecord& record : records) {
    const MemoryOperation& operation = operations[record.operation];
    if (operation.bytes == 0) continue;
    Address& near = last_addresses_.of(record.context, operation.kind);
    steps_.push_back(zigzag(static_cast<std::int64_t>(record.address - near)));
    near = record.address;
  }
  addresses_.put_all(steps_.size(), [&](std::size_t i) { return steps_[i]; });
  num_records_ += static_cast<std::uint32_t>(count);
}

void MemoryBlockWriter::add(const ChainStart& chain) {
  const bool all = chain.cause_stream == AccessCause::kAllEarlier;
  const std::size_t stream = all ? 0 : chain.cause_stream + std::size_t{1};
  cause_streams_.put(stream);
  if (last_causes_.size() <= stream) last_causes_.resize(stream + 1);
  const std::uint64_t cause = chain.cause_record << 1 | (chain.cause_ended ? 1 : 0);
  cause_records_.put(zigzag(static_cast<std::int64_t>(cause - last_causes_[stream])));
  last_causes_[stream] = cause;
  gaps_.put(chain.gap);
  epochs_.put(chain.epoch - last_epoch_);
  last_epoch_ = chain.epoch;
}

ByteVector MemoryBlockWriter::take() {
  NumberColumn* const in_order[] = {&contexts_,      &cycles_,        &codes_, &addresses_,
                                    &cause_streams_, &cause_records_, &gaps_,  &epochs_};
  ByteVector raw;
  ColumnWriter columns(raw);
  for (NumberColumn* column : in_order) {
    columns.numbers(*column);
    column->clear();
  }
  last_addresses_.clear();
  last_causes_.clear();
  last_cycle_ = 0;
  last_epoch_ = 0;
  num_records_ = 0;
  return raw;
}

namespace {

// Checks each number against what the records before it, and the layout, allow.
std::size_t decode_records(ColumnReader& columns, std::size_t stream, std::uint32_t count,
                           const MemoryLayout& layout, MemoryBlock& block) {
  std::vector<std::uint8_t> contexts;
  std::vector<std::uint64_t> cycles;
  std::vector<std::uint64_t> codes;
  std::vector<std::uint64_t> addresses;
  columns.bytes(count, contexts);
  columns.varints(count, cycles);
  columns.varints(count, codes);
  std::size_t num_addresses = 0;
  for (const std::uint64_t code : codes) {
    if (code >> kFlagBits >= layout.operations.size()) {
      throw BadColumn("a record has an operation that there is not");
    }
    if (layout.operations[code >> kFlagBits].bytes != 0) ++num_addresses;
  }
  columns.varints(num_addresses, addresses);

  LastAddresses last;
  std::size_t next_address = 0;
  std::size_t num_chains = 0;
  MemoryRecord record;
  for (std::uint32_t i = 0; i < count; ++i) {
    const MemoryRecord before = record;
    record.context = contexts[i];
    record.operation = static_cast<std::uint32_t>(codes[i] >> kFlagBits);
    record.begins = (codes[i] & kBeginsFlag) != 0;
    record.continues = (codes[i] & kContinuesFlag) != 0;
    record.ends = (codes[i] & kEndsFlag) != 0;
    const MemoryOperation& operation = layout.operations[record.operation];
    if (record.context >= layout.streams[stream].contexts) {
      throw BadColumn("a record has a context that there is not");
    }
    if (cycles[i] > kMaxCycle - record.cycle) throw BadColumn("a record has an impossible cycle");
    record.cycle += cycles[i];
    if (record.continues &&
        (i == 0 || record.begins || cycles[i] != 0 || operation.bytes == 0 ||
         record.operation != before.operation || record.context != before.context)) {
      throw BadColumn("a record continues a step that is not its own");
    }
    if (operation.bytes != 0 && operation.write == layout.streams[stream].awaited) {
      throw BadColumn("a record writes for a unit that others wait for, or reads for one that not");
    }
    if (operation.bytes != 0 && operation.cache >= layout.streams[stream].caches.size()) {
      throw BadColumn("a record has a cache that its unit has not");
    }
    record.address = 0;
    if (operation.bytes != 0) {
      Address& near = last.of(record.context, operation.kind);
      near += static_cast<Address>(unzigzag(addresses[next_address++]));
      if (near >= kMaxAddress) throw BadColumn("a record has an impossible address");
      record.address = near;
    }
    if (record.begins) ++num_chains;
    block.records.push_back(record);
  }
  return num_chains;
}

void decode_chains(ColumnReader& columns, std::size_t count, std::size_t num_streams,
                   MemoryBlock& block) {
  std::vector<std::uint64_t> streams;
  std::vector<std::uint64_t> records;
  std::vector<std::uint64_t> gaps;
  std::vector<std::uint64_t> epochs;
  columns.varints(count, streams);
  columns.varints(count, records);
  columns.varints(count, gaps);
  columns.varints(count, epochs);
  std::vector<std::uint64_t> last(num_streams + 1);  // by the column of streams
  std::uint64_t epoch = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (streams[i] > num_streams) throw BadColumn("a chain has a cause in no stream");
    if (gaps[i] > kMaxCycle || epochs[i] > kMaxCycle - epoch) {
      throw BadColumn("a chain has an impossible time");
    }
    std::uint64_t& near = last[streams[i]];
    near += static_cast<std::uint64_t>(unzigzag(records[i]));
    if (near >> 1 > first_of_key(~std::uint64_t{0})) {
      throw BadColumn("a chain has an impossible cause");
    }
    epoch += epochs[i];
    const std::uint16_t stream =
        streams[i] == 0 ? AccessCause::kAllEarlier : static_cast<std::uint16_t>(streams[i] - 1);
    block.chains.push_back({stream, near >> 1, (near & 1) != 0, gaps[i], epoch});
  }
}

}  // namespace

void decode_memory_block(ByteSpan raw, std::size_t stream, std::uint32_t num_records,
                         const MemoryLayout& layout, MemoryBlock& block) {
  if (stream >= layout.streams.size()) throw BadColumn("it is of a stream that there is not");
  ColumnReader columns(raw);
  const std::size_t num_chains = decode_records(columns, stream, num_records, layout, block);
  decode_chains(columns, num_chains, layout.streams.size(), block);
  columns.finish();
}

}  // namespace sheaf
