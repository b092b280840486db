// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/trace_writer.h"

#include <fmt/format.h>
#include <zstd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "base/errors.h"

namespace sheaf {
namespace {

namespace fs = std::filesystem;

// Recording must be cheap: level 1 packs several hundred megabytes a second.
constexpr int kCompressionLevel = 1;

}  // namespace

TraceWriter::TraceWriter(fs::path path, const TraceIdentity& identity)
    : path_(std::move(path)),
      temporary_(path_.string() + ".partial"),
      file_(std::fopen(temporary_.c_str(), "wb")),
      zstd_(ZSTD_createCCtx(), ZSTD_freeCCtx) {
  if (file_ == nullptr) {
    error_ = errno;
    refuse();
  }
  ZSTD_CCtx_setParameter(zstd_.get(), ZSTD_c_compressionLevel, kCompressionLevel);
  ZSTD_CCtx_setParameter(zstd_.get(), ZSTD_c_contentSizeFlag, 1);
  write(encode_header(identity));
}

TraceWriter::~TraceWriter() {
  close();
  if (finished_) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void TraceWriter::close() {
  if (file_ == nullptr) return;
  if (std::fclose(file_) != 0 && error_ == 0) error_ = errno;  // a full disk may only show here
  file_ = nullptr;
}

void TraceWriter::refuse() const {
  throw Error(ExitCode::kOutput,
              fmt::format("{}: the trace cannot be written: {}; no trace is left", path_.string(),
                          std::strerror(error_)));
}

void TraceWriter::write(ByteSpan bytes) {
  if (error_ != 0) return;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) error_ = errno;
  offset_ += bytes.size();
}

void TraceWriter::add(std::uint64_t key, std::uint32_t num_records, ByteSpan raw) {
  num_records_ += num_records;
  add_frame(FrameType::kData, key, num_records, raw);
}

void TraceWriter::add_frame(FrameType type, std::uint64_t key, std::uint32_t num_records,
                            ByteSpan raw) {
  if (error_ != 0) return;
  if (type != FrameType::kIndex && raw.size() > kMaxFrameBytes) {
    throw std::logic_error("a trace frame is too large");
  }
  stored_.resize(ZSTD_compressBound(raw.size()));
  const std::size_t size =
      ZSTD_compress2(zstd_.get(), stored_.data(), stored_.size(), raw.data(), raw.size());
  if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
  stored_.resize(size);
  const TraceFrame frame{offset_,
                         type,
                         key,
                         num_records,
                         static_cast<std::uint32_t>(raw.size()),
                         static_cast<std::uint32_t>(size)};
  write(encode_frame_header(frame, stored_));
  write(stored_);
  frames_.push_back(frame);
}

void TraceWriter::finish(const std::string& metadata) {
  add_frame(FrameType::kMetadata, 0, 0,
            {reinterpret_cast<const std::uint8_t*>(metadata.data()), metadata.size()});
  TraceTrailer trailer{offset_, frames_.size(), num_records_, 0};
  ByteVector index;
  for (const TraceFrame& frame : frames_) encode_index_entry(frame, index);
  add_frame(FrameType::kIndex, 0, static_cast<std::uint32_t>(trailer.num_frames), index);
  trailer.file_bytes = offset_ + kTraceTrailerBytes;
  write(encode_trailer(trailer));
  close();
  if (error_ != 0) refuse();
  std::error_code problem;
  fs::rename(temporary_, path_, problem);
  if (problem) {
    error_ = problem.value();
    refuse();
  }
  finished_ = true;
}

}  // namespace sheaf
