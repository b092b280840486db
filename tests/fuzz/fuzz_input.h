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

/// Gives an input to what reads files. A refusal by Error is right; whatever else is thrown, or a
/// crash, is what a fuzzer looks for.
inline void read_as_file(const std::uint8_t* data, std::size_t size, const char* name,
                         const std::function<void(const std::filesystem::path&)>& read) {
  static const std::filesystem::path folder = [] {
    std::string made = (std::filesystem::temp_directory_path() / "sheaf-fuzz-XXXXXX").string();
    if (mkdtemp(made.data()) == nullptr) std::abort();
    std::atexit([] { std::filesystem::remove_all(folder); });
    return std::filesystem::path(made);
  }();
  const std::filesystem::path path = folder / name;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    read(path);
  } catch (const Error&) {
    return;
  }
}

}  // namespace sheaf::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
