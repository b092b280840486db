// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>

namespace sheaf {

/// A file that is written piece by piece and is there as a whole or not at all: what has not been
/// closed is removed. All throw Error(kOutput, "<path>: <reason>") if they fail.
class FileOutput {
 public:
  explicit FileOutput(std::filesystem::path path);
  ~FileOutput();
  FileOutput(const FileOutput&) = delete;
  FileOutput& operator=(const FileOutput&) = delete;

  void write(std::span<const std::uint8_t> bytes);
  /// The next write goes to this byte.
  void seek(std::uint64_t position);
  [[nodiscard]] std::uint64_t position() const { return position_; }
  /// Throws too if a write has failed whose exception was lost on its way.
  void close();

 private:
  [[noreturn]] void fail(int reason);

  const std::filesystem::path path_;
  std::FILE* file_;
  std::uint64_t position_ = 0;
  int failure_ = 0;  ///< errno of the first failure
};

}  // namespace sheaf
