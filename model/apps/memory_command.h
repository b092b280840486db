// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "memory/dram/stream.h"

namespace CLI {
class App;
}

namespace sheaf {

struct MemoryOptions {
  std::string trace;  ///< empty: generate
  std::optional<StreamKind> generate;
  std::uint64_t count = 1'000'000;
  std::uint64_t gap = 0;
  std::uint64_t seed = 1;
  double write_share = 0;
  std::uint64_t bytes = 64;
  std::optional<std::filesystem::path> config;
  std::vector<std::string> settings;
  bool json = false;
};

/// Declares `sheaf memory`, bound to `options`.
void declare_memory_command(CLI::App& app, MemoryOptions& options);

/// `sheaf memory`: drives the memory alone and prints what came of it. Returns an exit code; throws
/// Error for what the user can mend.
int memory_command(const MemoryOptions& options);

}  // namespace sheaf
