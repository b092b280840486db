// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "base/errors.h"

namespace sheaf::test {

using ReadsFile = std::function<void(const std::filesystem::path&)>;

/// Calls what writes and reads a file of that name. A refusal by Error is right; whatever else is
/// thrown, or a crash, is what a fuzzer looks for.
inline void read_file(const char* name, const ReadsFile& read) {
  static const std::filesystem::path folder = [] {
    std::string made = (std::filesystem::temp_directory_path() / "sheaf-fuzz-XXXXXX").string();
    if (mkdtemp(made.data()) == nullptr) std::abort();
    std::atexit([] { std::filesystem::remove_all(folder); });
    return std::filesystem::path(made);
  }();
  try {
    read(folder / name);
  } catch (const Error&) {
    return;
  }
}

/// Gives an input to what reads files.
inline void read_as_file(const std::uint8_t* data, std::size_t size, const char* name,
                         const ReadsFile& read) {
  read_file(name, [&](const std::filesystem::path& path) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    read(path);
  });
}

}  // namespace sheaf::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
