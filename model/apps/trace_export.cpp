// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/trace_export.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <system_error>
#include <utility>

#include "base/errors.h"
#include "system/dram_requests.h"
#include "tracefile/recorded_config.h"

namespace sheaf {
namespace {

namespace fs = std::filesystem;

/// A pipe or a device: something that is there to be written into, not to be replaced.
bool is_special(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status);
}

/// Lines of text into a file that appears whole or not at all, into a pipe or a device, or to
/// standard output.
class TextOutput {
 public:
  explicit TextOutput(const fs::path& path) : path_(path) {
    if (path.empty()) return;
    if (!is_special(path)) temporary_ = path.string() + ".partial";
    file_ = std::fopen((temporary_.empty() ? path : temporary_).c_str(), "wb");
    if (file_ == nullptr) refuse();
  }
  ~TextOutput() {
    if (path_.empty() || file_ == nullptr) return;
    std::fclose(file_);
    remove_temporary();
  }
  TextOutput(const TextOutput&) = delete;
  TextOutput& operator=(const TextOutput&) = delete;

  /// What is appended here is written before long.
  [[nodiscard]] std::string& text() {
    if (text_.size() >= kBuffer) write();
    return text_;
  }
  void finish() {
    write();
    if (path_.empty()) {
      if (std::fflush(stdout) != 0) refuse();
      return;
    }
    std::FILE* const file = std::exchange(file_, nullptr);
    if (std::fclose(file) != 0) refuse();
    if (temporary_.empty()) return;
    std::error_code problem;
    fs::rename(temporary_, path_, problem);
    if (problem) throw Error(ExitCode::kOutput, path_.string() + ": " + problem.message());
  }

 private:
  static constexpr std::size_t kBuffer = 1 << 16;
  void write() {
    if (std::fwrite(text_.data(), 1, text_.size(), file_) != text_.size()) refuse();
    text_.clear();
  }
  void remove_temporary() const {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove(temporary_, ignored);
  }
  [[noreturn]] void refuse() {
    const int error = errno;
    if (file_ == nullptr) remove_temporary();
    throw Error(ExitCode::kOutput, fmt::format("{}: cannot be written: {}",
                                               path_.empty() ? "standard output" : path_.string(),
                                               std::strerror(error)));
  }

  const fs::path path_;
  fs::path temporary_;  ///< renamed in the end; empty: what is there is written into
  std::FILE* file_ = stdout;
  std::string text_;
};

using Format = TraceOptions::Format;

void put_line(const LineAccess& access, Format format, std::string& text) {
  const auto out = std::back_inserter(text);
  switch (format) {
    case Format::kRamulator2:
      if (access.write) {
        fmt::format_to(out, "ST {}\n", access.address);
      } else {
        fmt::format_to(out, "LD 0x{:x}\n", access.address);
      }
      return;
    case Format::kDramSim3:
      fmt::format_to(out, "0x{:X} {} {}\n", access.address, access.write ? "WRITE" : "READ",
                     access.cycle);
      return;
    case Format::kDramSys:
      fmt::format_to(out, "{}: {} 0x{:x}\n", access.cycle, access.write ? "write" : "read",
                     access.address);
      return;
  }
}

}  // namespace

void export_trace(const TraceOptions& options, TraceReader& reader, const TraceMetadata& metadata) {
  const Config config = recorded_config(reader, metadata).config;
  std::error_code ignored;
  if (fs::equivalent(options.out, options.trace, ignored)) {
    throw Error(ExitCode::kUsage,
                fmt::format("--out {}: is the trace to be exported; name another file",
                            options.out.string()));
  }
  TextOutput output(options.out);
  const auto sink = [&](const LineAccess& access) {
    put_line(access, options.format, output.text());
  };
  MemoryAccesses accesses(reader, metadata.memory);
  DramRequests requests(config, metadata.memory, sink);
  for (auto access = accesses.next(); access.record != nullptr; access = accesses.next()) {
    if (options.level == TraceOptions::Level::kDram) {
      requests.add(access);
    } else {
      sink({access.record->address, access.record->cycle, access.operation->bytes,
            access.operation->write});
    }
  }
  if (options.level == TraceOptions::Level::kDram) requests.finish();
  output.finish();
}

}  // namespace sheaf
