// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/memory_stream.h"

#include <string>

#include "tracefile/columns.h"

namespace sheaf {
namespace {

// What keeps a small file from asking for much memory or text. A record touches a node, a
// triangle, a texel or a pixel, of 128 bytes at most (MemoryMap, FilmFormat::kExact), or a leaf's
// list: 4 bytes for each of the triangles that records of their own follow for. The rest is for
// lists whose triangles were still to come when the recording was cut short.
constexpr std::uint64_t kBytesPerRecord = 256;
constexpr std::uint64_t kBytesCutShort = std::uint64_t{1} << 16;

}  // namespace

MemoryStream::MemoryStream(TraceReader& reader, const MemoryLayout& layout, std::size_t stream)
    : reader_(reader), layout_(layout), stream_(stream) {
  for (const TraceFrame& frame : reader.frames()) {
    if (stream_of_key(frame.key) >= layout.streams.size()) {
      reader.refuse(frame, "there are records of a stream that the metadata do not name");
    }
    if (stream_of_key(frame.key) != stream) continue;
    if (first_of_key(frame.key) != num_records_) {
      reader.refuse(frame, "records are missing before it");
    }
    if (frame.num_records > kMaxBlockRecords) reader.refuse(frame, "it has too many records");
    num_records_ += frame.num_records;
    frames_.push_back(frame);
  }
  allowance_ = kBytesPerRecord * num_records_ + kBytesCutShort;
}

bool MemoryStream::load() {
  do {
    if (next_frame_ == frames_.size()) return false;
    load_frame(frames_[next_frame_++]);
  } while (block_.records.empty());
  return true;
}

void MemoryStream::load_frame(const TraceFrame& frame) {
  reader_.read(frame, raw_);
  block_.clear();
  try {
    decode_memory_block(raw_, stream_, frame.num_records, layout_, block_);
  } catch (const BadColumn& problem) {
    reader_.refuse(frame, problem.what());
  }
  count_bytes(frame);
  first_ = first_of_key(frame.key);
  next_record_ = 0;
  next_chain_ = 0;
}

void MemoryStream::count_bytes(const TraceFrame& frame) {
  for (const MemoryRecord& record : block_.records) {
    const std::uint64_t bytes = layout_.operations[record.operation].bytes;
    if (bytes > allowance_) reader_.refuse(frame, "its records touch more than there can be");
    allowance_ -= bytes;
  }
}

MemoryAccesses::MemoryAccesses(TraceReader& reader, const MemoryLayout& layout) : layout_(layout) {
  for (std::size_t stream = 0; stream < layout.streams.size(); ++stream) {
    streams_.emplace_back(reader, layout, stream);
  }
}

MemoryAccesses::Access MemoryAccesses::next() {
  if (begun_) streams_[last_].pop();
  begun_ = true;
  Access first;
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    const MemoryRecord* record = streams_[i].peek();
    while (record != nullptr && layout_.operations[record->operation].bytes == 0) {
      streams_[i].pop();
      record = streams_[i].peek();
    }
    if (record == nullptr) continue;
    if (first.record == nullptr || record->cycle < first.record->cycle)
      first = {i, record, nullptr};
  }
  if (first.record == nullptr) {
    begun_ = false;
    return first;
  }
  last_ = first.stream;
  first.operation = &layout_.operations[first.record->operation];
  return first;
}

}  // namespace sheaf
