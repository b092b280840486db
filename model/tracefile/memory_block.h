// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/access_cause.h"
#include "tracefile/byte_order.h"
#include "tracefile/memory_layout.h"

namespace sheaf {

/// One access of a unit to a private cache, or a step that accesses nothing.
struct MemoryRecord {
  Address address = 0;
  Cycles cycle = 0;             ///< of the step's first look-up
  std::uint32_t operation = 0;  ///< of the layout's
  std::uint8_t context = 0;
  bool begins = false;     ///< the first of a chain
  bool ends = false;       ///< the last of a chain
  bool continues = false;  ///< of the same step as the record before it
};

/// How a chain of steps came to begin: `gap` cycles after its cause was done, if a context was
/// free; what its context did before is over at any rate.
struct ChainStart {
  std::uint16_t cause_stream = AccessCause::kAllEarlier;
  std::uint64_t cause_record = 0;  ///< number in that stream; 0 if all of earlier epochs
  bool cause_ended = false;        ///< not the step alone, but the chain that it ends
  Cycles gap = 0;
  std::uint64_t epoch = 0;  ///< between two epochs nothing was going on
};

/// Consecutive records of one stream, and the starts of the chains that begin among them.
struct MemoryBlock {
  std::vector<MemoryRecord> records;
  std::vector<ChainStart> chains;

  void clear() {
    records.clear();
    chains.clear();
  }
};

/// Records of a frame at most. A recorder writes 2^16, and the rest of the step that it is at.
inline constexpr std::uint32_t kMaxBlockRecords = 1U << 17;

/// A frame's key names its stream and the number of its first record.
[[nodiscard]] constexpr std::uint64_t memory_key(std::size_t stream, std::uint64_t first) {
  return std::uint64_t{stream} << 48 | first;
}
[[nodiscard]] constexpr std::size_t stream_of_key(std::uint64_t key) {
  return key >> 48;
}
[[nodiscard]] constexpr std::uint64_t first_of_key(std::uint64_t key) {
  return key & ((std::uint64_t{1} << 48) - 1);
}

/// The content of a frame; traces/README.md describes it. The records' operations are numbers among
/// these.
[[nodiscard]] ByteVector encode_memory_block(const MemoryBlock& block,
                                             const std::vector<MemoryOperation>& operations);

/// The inverse, appended to `block`. Throws BadColumn for what is no frame of `num_records` records
/// of this stream; what it accepts refers only to what the layout has, and its steps are whole.
void decode_memory_block(ByteSpan raw, std::size_t stream, std::uint32_t num_records,
                         const MemoryLayout& layout, MemoryBlock& block);

}  // namespace sheaf
