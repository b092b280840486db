// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tracefile/container.h"

struct ZSTD_DCtx_s;

namespace sheaf {

/// Reads a trace that may be anything: whatever is wrong is refused with Error(kTrace), one line
/// that names file, place and remedy. Holds only the index in memory.
class TraceReader {
 public:
  /// Checks header, trailer and index, and that the frames fill the file without a gap.
  explicit TraceReader(std::filesystem::path path);

  /// Checks that this is a trace of the kind; `purpose` ends the sentence "… needs a … trace".
  void require(TraceKind kind, const std::string& purpose) const;

  /// Checks every byte of every frame against the checksums. What read() gives after that is what
  /// was written.
  void verify();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const TraceIdentity& identity() const { return identity_; }
  /// A JSON object.
  [[nodiscard]] const std::string& metadata() const { return metadata_; }
  /// Data frames in the order of the file.
  [[nodiscard]] const std::vector<TraceFrame>& frames() const { return frames_; }
  [[nodiscard]] std::uint64_t num_records() const { return trailer_.num_records; }
  [[nodiscard]] std::uint64_t file_bytes() const { return trailer_.file_bytes; }

  /// The unpacked content of a frame.
  void read(const TraceFrame& frame, ByteVector& raw);

  /// Throws Error(kTrace): what is wrong at a place in the file, or in one frame.
  [[noreturn]] void refuse(std::uint64_t offset, const std::string& problem) const;
  [[noreturn]] void refuse(const TraceFrame& frame, const std::string& problem) const;

 private:
  void read_header();
  void read_trailer();
  void read_index();
  void check_tiling(const TraceFrame& index) const;
  TraceFrame read_frame_header(std::uint64_t offset, ByteVector& header);
  void read_stored(const TraceFrame& frame, ByteSpan header);
  void read_at(std::uint64_t offset, std::size_t size, ByteVector& bytes);

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::unique_ptr<ZSTD_DCtx_s, std::size_t (*)(ZSTD_DCtx_s*)> zstd_;
  std::uint64_t size_ = 0;
  TraceIdentity identity_;
  TraceTrailer trailer_;
  std::vector<TraceFrame> frames_;
  TraceFrame metadata_frame_;
  std::string metadata_;
  ByteVector stored_;
};

}  // namespace sheaf
