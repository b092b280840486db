// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/file_output.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "base/errors.h"

namespace sheaf {

FileOutput::FileOutput(std::filesystem::path path)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wb")) {
  if (file_ == nullptr) fail(errno);
}

FileOutput::~FileOutput() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path_, ignored)) {  // a device is not ours to remove
    std::filesystem::remove(path_, ignored);
  }
}

void FileOutput::fail(int reason) {
  if (failure_ == 0) failure_ = reason;
  throw Error(ExitCode::kOutput,
              path_.string() + ": cannot be written: " + std::strerror(failure_));
}

void FileOutput::write(std::span<const std::uint8_t> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(errno);
  position_ += bytes.size();
}

void FileOutput::seek(std::uint64_t position) {
  if (std::fseek(file_, static_cast<long>(position), SEEK_SET) != 0) fail(errno);
  position_ = position;
}

void FileOutput::close() {
  if (failure_ != 0) fail(failure_);
  if (std::fflush(file_) != 0) fail(errno);  // a full disk may only show here
  std::FILE* const file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) fail(errno);
}

}  // namespace sheaf
