// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/bounded_queue.h"
#include "tracefile/container.h"

struct ZSTD_CCtx_s;

namespace sheaf {

/// Writes a trace frame by frame under a temporary name and renames it when it is whole. Keeps only
/// the index in memory, 32 bytes a frame, and few frames that a thread of its own has yet to
/// pack, compress and write, in the order in which they come.
///
/// Called from within a simulation, where exceptions have nowhere to go: a failure to write is
/// remembered, what follows is dropped, and finish() throws. Poll failed() to stop early.
class TraceWriter {
 public:
  /// Throws Error(kOutput) if the file cannot be made.
  TraceWriter(std::filesystem::path path, const TraceIdentity& identity);
  /// Removes the temporary file, unless finish() has been called.
  ~TraceWriter();
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;

  /// Packs the content of a frame, at most kMaxFrameBytes; called by the writer's thread.
  using Pack = std::function<ByteVector()>;
  /// One data frame, to be packed, compressed and written. Waits while too many are.
  void add(std::uint64_t key, std::uint32_t num_records, Pack pack);

  [[nodiscard]] bool failed() const { return error_ != 0; }

  /// Writes metadata (a JSON object as text), index and trailer, and gives the file its name.
  /// Throws Error(kOutput), with no file left, if anything could not be written.
  void finish(const std::string& metadata);

 private:
  struct Frame {
    FrameType type;
    std::uint64_t key;
    std::uint32_t num_records;
    Pack pack;
  };
  void start_thread();
  void write_queued();
  void write(ByteSpan bytes);
  void write_frame(const Frame& frame);
  void close();
  void remove_temporary();
  [[noreturn]] void refuse() const;

  static constexpr std::size_t kMaxQueued = 4;

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::FILE* file_ = nullptr;
  std::unique_ptr<ZSTD_CCtx_s, std::size_t (*)(ZSTD_CCtx_s*)> zstd_;
  ByteVector stored_;
  std::vector<TraceFrame> frames_;
  std::uint64_t offset_ = 0;
  std::uint64_t num_records_ = 0;
  std::atomic<int> error_ = 0;  ///< errno of the first failure
  bool finished_ = false;

  BoundedQueue<Frame> queue_{kMaxQueued};
  std::exception_ptr thrown_;  ///< by the thread
  std::thread thread_;         ///< while it runs, file and frames are its own
};

}  // namespace sheaf
