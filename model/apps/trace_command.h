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
  What what = What::kInfo;
  std::filesystem::path trace;
  std::string format = "dramsim3";  ///< or ramulator2, dramsys
  std::string level = "dram";       ///< or units
  std::filesystem::path out;        ///< empty: standard output
};

/// Declares `sheaf trace` with info, verify and export, bound to `options`.
void declare_trace_command(CLI::App& app, TraceOptions& options);

/// `sheaf trace`. Returns an exit code; throws Error for what the user can mend.
int trace_command(const TraceOptions& options);

}  // namespace sheaf
