// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/file_output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>

#include "base/errors.h"

namespace sheaf {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int reason) {
  throw Error(ExitCode::kOutput, path.string() + ": cannot be written: " + std::strerror(reason));
}

}  // namespace

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) {
    fail(path, errno);
  }
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int write_error = errno;
  const bool closed = std::fclose(file) == 0;  // a full disk may only show here
  if (written && closed) {
    return;
  }
  const int reason = written ? errno : write_error;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) {  // a device is not ours to remove
    std::filesystem::remove(path, ignored);
  }
  fail(path, reason);
}

}  // namespace sheaf
