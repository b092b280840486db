// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/trace_reader.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/errors.h"

namespace sheaf {
namespace {

constexpr const char* kRemedy = "record it again or take another copy";

TraceFrame decode_index_entry(ByteSpan bytes, std::size_t at) {
  TraceFrame frame;
  frame.offset = get_le<std::uint64_t>(bytes, at);
  frame.key = get_le<std::uint64_t>(bytes, at + 8);
  frame.num_records = get_le<std::uint32_t>(bytes, at + 16);
  frame.raw_bytes = get_le<std::uint32_t>(bytes, at + 20);
  frame.stored_bytes = get_le<std::uint32_t>(bytes, at + 24);
  frame.type = static_cast<FrameType>(get_le<std::uint32_t>(bytes, at + 28));
  return frame;
}

bool same(const TraceFrame& a, const TraceFrame& b) {
  return a.offset == b.offset && a.type == b.type && a.key == b.key &&
         a.num_records == b.num_records && a.raw_bytes == b.raw_bytes &&
         a.stored_bytes == b.stored_bytes;
}

}  // namespace

TraceReader::TraceReader(std::filesystem::path path)
    : path_(std::move(path)),
      file_(std::fopen(path_.c_str(), "rb"), std::fclose),
      zstd_(ZSTD_createDCtx(), ZSTD_freeDCtx) {
  struct stat status {};
  if (file_ == nullptr || fstat(fileno(file_.get()), &status) != 0) {
    throw Error(ExitCode::kTrace,
                fmt::format("{}: cannot be read: {}", path_.string(), std::strerror(errno)));
  }
  if (!S_ISREG(status.st_mode)) {
    throw Error(ExitCode::kTrace,
                fmt::format("{}: is no regular file; name a trace", path_.string()));
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  read_header();
  read_trailer();
  read_index();
  ByteVector text;
  read(metadata_frame_, text);
  metadata_.assign(text.begin(), text.end());
}

void TraceReader::refuse(std::uint64_t offset, const std::string& problem) const {
  throw Error(ExitCode::kTrace,
              fmt::format("{}: byte {}: {}; {}", path_.string(), offset, problem, kRemedy));
}

void TraceReader::refuse(const TraceFrame& frame, const std::string& problem) const {
  refuse(frame.offset, "in the frame that begins here, " + problem);
}

void TraceReader::require(TraceKind kind, const std::string& purpose) const {
  if (identity_.kind == kind) return;
  throw Error(
      ExitCode::kTrace,
      fmt::format("{}: is a trace of {}, but {} needs one of {}; record it with --record {}",
                  path_.string(), to_string(identity_.kind), purpose, to_string(kind),
                  to_string(kind)));
}

void TraceReader::read_at(std::uint64_t offset, std::size_t size, ByteVector& bytes) {
  bytes.resize(size);
  if (fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0 ||
      std::fread(bytes.data(), 1, size, file_.get()) != size) {
    refuse(offset, fmt::format("{} bytes cannot be read", size));
  }
}

void TraceReader::read_header() {
  ByteVector bytes;
  read_at(0, std::min<std::uint64_t>(size_, kTraceHeaderBytes), bytes);
  const std::size_t known = std::min(bytes.size(), kTraceMagic.size());
  if (known == 0 || !std::equal(kTraceMagic.begin(), kTraceMagic.begin() + known, bytes.begin())) {
    throw Error(ExitCode::kTrace,
                fmt::format("{}: is no trace of Sheaf; record one with 'sheaf run --record'",
                            path_.string()));
  }
  if (bytes.size() < kTraceHeaderBytes) refuse(size_, "the file ends within its header");
  const auto version = get_le<std::uint32_t>(bytes, 8);
  if (version != kTraceVersion) {
    throw Error(ExitCode::kTrace,
                fmt::format("{}: byte 8: is a trace of version {}, this Sheaf reads version {}; "
                            "record it again with this Sheaf",
                            path_.string(), version, kTraceVersion));
  }
  if (checksum(ByteSpan(bytes).first(56), 0) != get_le<std::uint64_t>(bytes, 56)) {
    refuse(0, "the header does not match its checksum");
  }
  const auto kind = get_le<std::uint32_t>(bytes, 12);
  if (kind != 1 && kind != 2) refuse(12, fmt::format("there is no kind of trace {}", kind));
  if (get_le<std::uint64_t>(bytes, 48) != 0) refuse(48, "reserved bytes are not zero");
  identity_.kind = static_cast<TraceKind>(kind);
  std::copy_n(bytes.begin() + 16, 16, identity_.scene_hash.begin());
  std::copy_n(bytes.begin() + 32, 16, identity_.config_hash.begin());
}

void TraceReader::read_trailer() {
  if (size_ < kTraceHeaderBytes + 2 * kFrameHeaderBytes + kTraceTrailerBytes) {
    refuse(size_, "the file ends before its trailer: it is truncated");
  }
  const std::uint64_t at = size_ - kTraceTrailerBytes;
  ByteVector bytes;
  read_at(at, kTraceTrailerBytes, bytes);
  if (!std::equal(kTraceEndMagic.begin(), kTraceEndMagic.end(), bytes.begin() + 32)) {
    refuse(at, "the file does not end with a trailer: it is truncated or damaged");
  }
  if (checksum(ByteSpan(bytes).first(40), 0) != get_le<std::uint64_t>(bytes, 40)) {
    refuse(at, "the trailer does not match its checksum");
  }
  trailer_ = {get_le<std::uint64_t>(bytes, 0), get_le<std::uint64_t>(bytes, 8),
              get_le<std::uint64_t>(bytes, 16), get_le<std::uint64_t>(bytes, 24)};
  if (trailer_.file_bytes != size_) {
    refuse(at + 24,
           fmt::format("the trace was {} bytes long, the file is {}", trailer_.file_bytes, size_));
  }
  if (trailer_.index_offset < kTraceHeaderBytes || trailer_.index_offset > at - kFrameHeaderBytes ||
      trailer_.num_frames > size_ / kFrameHeaderBytes) {
    refuse(at, "the trailer names an index outside the file");
  }
}

// Checks everything about a frame's header that does not depend on its neighbours.
TraceFrame TraceReader::read_frame_header(std::uint64_t offset, ByteVector& header) {
  read_at(offset, kFrameHeaderBytes, header);
  if (get_le<std::uint32_t>(header, 0) != kFrameMagic) refuse(offset, "no frame begins here");
  if (checksum(ByteSpan(header).first(40), offset) != get_le<std::uint64_t>(header, 40)) {
    refuse(offset, "the frame's header does not match its checksum");
  }
  TraceFrame frame;
  frame.offset = offset;
  frame.type = static_cast<FrameType>(get_le<std::uint32_t>(header, 4));
  frame.key = get_le<std::uint64_t>(header, 8);
  frame.num_records = get_le<std::uint32_t>(header, 16);
  frame.raw_bytes = get_le<std::uint32_t>(header, 20);
  frame.stored_bytes = get_le<std::uint32_t>(header, 24);
  if (get_le<std::uint32_t>(header, 28) != 0) refuse(offset + 28, "reserved bytes are not zero");
  if (frame.stored_bytes > size_ - kTraceTrailerBytes - kFrameHeaderBytes - offset) {
    refuse(offset + 24, "the frame is longer than the file");
  }
  return frame;
}

void TraceReader::read_index() {
  ByteVector header;
  const TraceFrame index = read_frame_header(trailer_.index_offset, header);
  if (index.type != FrameType::kIndex ||
      index.raw_bytes != trailer_.num_frames * kIndexEntryBytes) {
    refuse(index, "there should be an index of all frames");
  }
  ByteVector bytes;
  read(index, bytes);
  for (std::size_t at = 0; at < bytes.size(); at += kIndexEntryBytes) {
    frames_.push_back(decode_index_entry(bytes, at));
  }
  check_tiling(index);
  metadata_frame_ = frames_.back();
  frames_.pop_back();
}

void TraceReader::check_tiling(const TraceFrame& index) const {
  std::uint64_t next = kTraceHeaderBytes;
  std::uint64_t records = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const TraceFrame& frame = frames_[i];
    const bool last = i + 1 == frames_.size();
    if (frame.offset != next || frame.raw_bytes > kMaxFrameBytes ||
        frame.type != (last ? FrameType::kMetadata : FrameType::kData)) {
      refuse(index, fmt::format("the entry of frame {} is wrong", i));
    }
    next += kFrameHeaderBytes + frame.stored_bytes;
    records += frame.num_records;
  }
  if (frames_.empty() || next != index.offset || records != trailer_.num_records ||
      index.offset + kFrameHeaderBytes + index.stored_bytes + kTraceTrailerBytes != size_) {
    refuse(index, "the frames it lists do not fill the file");
  }
}

// The frame's stored bytes, checked against its header.
void TraceReader::read_stored(const TraceFrame& frame, ByteSpan header) {
  read_at(frame.offset + kFrameHeaderBytes, frame.stored_bytes, stored_);
  if (checksum(stored_, frame.offset) != get_le<std::uint64_t>(header, 32)) {
    refuse(frame, "the content does not match its checksum");
  }
}

void TraceReader::read(const TraceFrame& frame, ByteVector& raw) {
  ByteVector header;
  if (!same(read_frame_header(frame.offset, header), frame)) {
    refuse(frame, "the header does not match the index");
  }
  read_stored(frame, header);
  raw.resize(frame.raw_bytes);
  const std::size_t size =
      ZSTD_decompressDCtx(zstd_.get(), raw.data(), raw.size(), stored_.data(), stored_.size());
  if (ZSTD_isError(size) != 0) refuse(frame, ZSTD_getErrorName(size));
  if (size != frame.raw_bytes) refuse(frame, "the content is shorter than it should be");
}

void TraceReader::verify() {
  ByteVector header;
  for (const TraceFrame& frame : frames_) {
    if (!same(read_frame_header(frame.offset, header), frame)) {
      refuse(frame, "the header does not match the index");
    }
    read_stored(frame, header);
  }
}

}  // namespace sheaf
