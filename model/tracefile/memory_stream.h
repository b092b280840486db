// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tracefile/memory_block.h"
#include "tracefile/trace_reader.h"

namespace sheaf {

/// The records of one stream of a memory trace, one after the other; holds one unpacked frame.
/// Reading throws Error(kTrace) for a frame that is not what it should be.
class MemoryStream {
 public:
  /// Both must stay. Throws Error(kTrace) for frames that are not those of a stream.
  MemoryStream(TraceReader& reader, const MemoryLayout& layout, std::size_t stream);

  /// Number of its records.
  [[nodiscard]] std::uint64_t size() const { return num_records_; }

  /// The record that comes next, or null at the end.
  [[nodiscard]] const MemoryRecord* peek() {
    if (next_record_ == block_.records.size() && !load()) return nullptr;
    return &block_.records[next_record_];
  }
  /// Of that record: its number in the stream, and the chain that it begins.
  [[nodiscard]] std::uint64_t number() const { return first_ + next_record_; }
  [[nodiscard]] const ChainStart& chain() const { return block_.chains[next_chain_]; }
  /// Throws Error(kTrace): something is wrong with that record.
  [[noreturn]] void refuse(const char* problem) const {
    reader_.refuse(frames_[next_frame_ - 1], problem);
  }
  void pop() {
    if (block_.records[next_record_].begins) ++next_chain_;
    ++next_record_;
  }

 private:
  /// The next frame that is not empty; false if there is none.
  bool load();
  void load_frame(const TraceFrame& frame);
  void count_bytes(const TraceFrame& frame);

  TraceReader& reader_;
  const MemoryLayout& layout_;
  const std::size_t stream_;
  std::vector<TraceFrame> frames_;
  std::uint64_t num_records_ = 0;
  std::uint64_t allowance_ = 0;  ///< bytes that the records to come may touch
  std::size_t next_frame_ = 0;
  ByteVector raw_;
  MemoryBlock block_;
  std::uint64_t first_ = 0;
  std::size_t next_record_ = 0;
  std::size_t next_chain_ = 0;
};

/// All accesses of a memory trace in the order of their cycles; of the same cycle, in the order of
/// the streams. Steps without access are passed over.
class MemoryAccesses {
 public:
  MemoryAccesses(TraceReader& reader, const MemoryLayout& layout);

  struct Access {
    std::size_t stream = 0;
    const MemoryRecord* record = nullptr;  ///< valid until the next call; null at the end
    const MemoryOperation* operation = nullptr;
  };
  [[nodiscard]] Access next();

 private:
  const MemoryLayout& layout_;
  std::vector<MemoryStream> streams_;
  std::size_t last_ = 0;
  bool begun_ = false;
};

}  // namespace sheaf
