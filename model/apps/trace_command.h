// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace CLI {
class App;
}

namespace sheaf {

struct TraceOptions {
  enum class What : std::uint8_t { kInfo, kVerify, kExport };
  enum class Format : std::uint8_t { kRamulator2, kDramSim3, kDramSys };
  enum class Level : std::uint8_t {
    kDram,  ///< what the recorded caches leave
    kUnits  ///< every access
  };
  What what = What::kInfo;
  std::filesystem::path trace;
  Format format = Format::kDramSim3;
  Level level = Level::kDram;
  std::filesystem::path out;  ///< empty: standard output
};

/// Declares `sheaf trace` with info, verify and export, bound to `options`.
void declare_trace_command(CLI::App& app, TraceOptions& options);

/// `sheaf trace`. Returns an exit code; throws Error for what the user can mend.
int trace_command(const TraceOptions& options);

}  // namespace sheaf
