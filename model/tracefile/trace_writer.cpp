// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/trace_writer.h"

#include <fmt/format.h>
#include <zstd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/errors.h"

namespace sheaf {
namespace {

namespace fs = std::filesystem;

// Recording must be cheap. Columns gain by the coding of their bytes; repetitions are few, and a
// table of the least size finds most of them: 1 to 5 % more bytes for two thirds of the time.
constexpr int kCompressionLevel = 1;
constexpr int kHashLog = 6;

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
  ZSTD_CCtx_setParameter(zstd_.get(), ZSTD_c_hashLog, kHashLog);
  ZSTD_CCtx_setParameter(zstd_.get(), ZSTD_c_contentSizeFlag, 1);
  write(encode_header(identity));
  start_thread();
}

void TraceWriter::start_thread() {
  try {
    thread_ = std::thread([this] { write_queued(); });
  } catch (const std::system_error& problem) {
    error_ = problem.code().value();
    close();
    remove_temporary();
    refuse();
  }
}

TraceWriter::~TraceWriter() {
  if (thread_.joinable()) {
    queue_.abandon();
    thread_.join();
  }
  close();
  if (!finished_) remove_temporary();
}

void TraceWriter::remove_temporary() {
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

void TraceWriter::add(std::uint64_t key, std::uint32_t num_records, Pack pack) {
  num_records_ += num_records;
  queue_.push({FrameType::kData, key, num_records, std::move(pack)});
}

// After a failure it goes on taking frames, and drops them, so that nobody waits for room for ever.
void TraceWriter::write_queued() {
  while (const std::optional<Frame> frame = queue_.pop()) {
    try {
      write_frame(*frame);
    } catch (...) {
      thrown_ = std::current_exception();
      error_ = ENOMEM;  // whatever it was: the run should stop
    }
  }
}

void TraceWriter::write_frame(const Frame& frame) {
  if (error_ != 0) return;
  const ByteVector raw = frame.pack();
  if (frame.type != FrameType::kIndex && raw.size() > kMaxFrameBytes) {
    throw std::logic_error("a trace frame is too large");
  }
  const std::size_t bound = ZSTD_compressBound(raw.size());
  if (stored_.size() < bound) stored_.resize(bound);
  const std::size_t size =
      ZSTD_compress2(zstd_.get(), stored_.data(), stored_.size(), raw.data(), raw.size());
  if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
  const ByteSpan stored(stored_.data(), size);
  const TraceFrame written{offset_,
                           frame.type,
                           frame.key,
                           frame.num_records,
                           static_cast<std::uint32_t>(raw.size()),
                           static_cast<std::uint32_t>(size)};
  write(encode_frame_header(written, stored));
  write(stored);
  frames_.push_back(written);
}

void TraceWriter::finish(const std::string& metadata) {
  queue_.push(
      {FrameType::kMetadata, 0, 0, [&] { return ByteVector(metadata.begin(), metadata.end()); }});
  queue_.close();
  thread_.join();
  if (thrown_) std::rethrow_exception(thrown_);
  TraceTrailer trailer{offset_, frames_.size(), num_records_, 0};
  ByteVector index;
  for (const TraceFrame& frame : frames_) encode_index_entry(frame, index);
  write_frame({FrameType::kIndex, 0, static_cast<std::uint32_t>(trailer.num_frames),
               [&] { return index; }});
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
