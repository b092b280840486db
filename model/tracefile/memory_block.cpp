// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/memory_block.h"

#include <array>
#include <utility>

#include "tracefile/columns.h"

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

constexpr std::size_t kMaxContexts = 64;

/// The last address of each context and kind of data, to which the next one is given.
class LastAddresses {
 public:
  Address& of(std::uint8_t context, DataKind kind) {
    return last_[context][static_cast<std::size_t>(kind)];
  }

 private:
  std::array<std::array<Address, kNumDataKinds>, kMaxContexts> last_{};
};

void put_records(const std::vector<MemoryRecord>& records,
                 const std::vector<MemoryOperation>& operations, ColumnWriter& columns) {
  NumberColumn contexts, cycles, codes, addresses;
  LastAddresses last;
  Cycles before = 0;
  for (const MemoryRecord& record : records) {
    contexts.put(record.context);  // less than 128, and so a byte
    cycles.put(record.cycle - std::exchange(before, record.cycle));
    codes.put(std::uint64_t{record.operation} << kFlagBits | (record.begins ? kBeginsFlag : 0) |
              (record.continues ? kContinuesFlag : 0) | (record.ends ? kEndsFlag : 0));
    const MemoryOperation& operation = operations[record.operation];
    if (operation.bytes == 0) continue;
    Address& near = last.of(record.context, operation.kind);
    addresses.put(zigzag(static_cast<std::int64_t>(record.address - near)));
    near = record.address;
  }
  for (const NumberColumn* column : {&contexts, &cycles, &codes, &addresses}) {
    columns.numbers(*column);
  }
}

void put_chains(const std::vector<ChainStart>& chains, ColumnWriter& columns) {
  NumberColumn streams, records, gaps, epochs;
  std::vector<std::uint64_t> last;  // causes, by what stands in the column of streams
  std::uint64_t epoch = 0;
  for (const ChainStart& chain : chains) {
    const bool all = chain.cause_stream == AccessCause::kAllEarlier;
    const std::size_t stream = all ? 0 : chain.cause_stream + std::size_t{1};
    if (last.size() <= stream) last.resize(stream + 1);
    const std::uint64_t cause = chain.cause_record << 1 | (chain.cause_ended ? 1 : 0);
    streams.put(stream);
    records.put(zigzag(static_cast<std::int64_t>(cause - std::exchange(last[stream], cause))));
    gaps.put(chain.gap);
    epochs.put(chain.epoch - std::exchange(epoch, chain.epoch));
  }
  for (const NumberColumn* column : {&streams, &records, &gaps, &epochs}) columns.numbers(*column);
}

}  // namespace

ByteVector encode_memory_block(const MemoryBlock& block,
                               const std::vector<MemoryOperation>& operations) {
  ByteVector raw;
  ColumnWriter columns(raw);
  put_records(block.records, operations, columns);
  put_chains(block.chains, columns);
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
